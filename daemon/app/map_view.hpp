// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "daemon/app/session_view.hpp"
#include "daemon/app/tile_book.hpp"
#include "daemon/control/json_rpc.hpp"
#include "daemon/threads/hand_overs.hpp"

namespace topo::daemon {

/// The map for displays, from the newest snapshot, which is pinned while it is read: the mapping thread never
/// waits. One thread at a time.
class MapView {
 public:
  MapView(HandOvers& hand_overs, const slam::GridParams& grid)
      : snapshots_(hand_overs.mapping.map->reader(kViewReader)), session_(grid) {}

  /// The tiles that changed after change `since` of an earlier answer, at most 128 kB of them:
  ///   {"revision": N, "more": false, "resolution_m": 0.05, "side": 64, "tiles": [[x, y, cells], ...]}
  /// "revision" is the next call's `since`; a tile's cells are in the form of encode_cells(), its first cell
  /// is cell (side x, side y) of the map. Numbers count from the daemon's start. kNotFound before the first
  /// map.
  types::Result<Json> tiles(std::uint64_t since);

  /// The ways of this robot and of each mate in the map, oldest first, thinned to at most 300 points each:
  ///   {"own": [[x, y], ...], "mates": [[[x, y], ...], ...]}, metres in map.
  types::Result<Json> trails();

  /// The robot's own keyframes, when the map is newer than at the last call.
  std::optional<std::vector<types::KeyframePose>> newer_keyframes();

  /// Of a session that is not the map.
  [[nodiscard]] SessionView& of_session() { return session_; }

 private:
  MapSnapshots::Reader snapshots_;
  TileBook book_;
  std::uint64_t drawn_ = 0;  ///< revision of the map in the book
  std::uint64_t told_ = 0;   ///< revision of newer_keyframes()
  SessionView session_;
};

}  // namespace topo::daemon
