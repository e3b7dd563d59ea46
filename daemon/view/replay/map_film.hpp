// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/slam/map_builder.hpp"
#include "daemon/app/tile_book.hpp"
#include "daemon/control/json_rpc.hpp"
#include "daemon/session/map_history.hpp"
#include "daemon/view/replay/team_scene.hpp"

namespace topo::daemon {

/// The map of a history, drawn as it was when it had so many keyframes. One thread.
class MapFilm {
 public:
  explicit MapFilm(const slam::GridParams& params) : params_(params) {}

  /// Another history, or more of the same; nothing is shown until show().
  void load(MapHistory history);
  /// Draws the map of the first `keyframes`. Forward it costs what is new or was corrected, backward the
  /// whole map. True when it is another one.
  bool show(std::size_t keyframes);

  /// As answers to "map.tiles" and "map.trails", of what is shown.
  [[nodiscard]] Json tiles(std::uint64_t since) const;
  [[nodiscard]] Json trails() const;
  /// Of each robot but the map's own.
  [[nodiscard]] std::vector<LastPlace> last_places() const;

 private:
  [[nodiscard]] bool is_own(std::uint16_t robot) const;

  slam::GridParams params_;
  MapHistory history_;
  std::vector<types::Se2> poses_;              ///< of the keyframes that are shown
  std::unique_ptr<slam::MapBuilder> builder_;  ///< null: nothing is drawn
  TileBook book_;
};

}  // namespace topo::daemon
