// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/app/session_view.hpp"

#include "core/slam/map_builder.hpp"
#include "daemon/app/display_json.hpp"
#include "daemon/session/session_reader.hpp"

namespace topo::daemon {

types::Result<Json> SessionView::tiles(const std::string& path, std::uint64_t since) {
  if (path != drawn_) {
    const auto loaded = load_session(path);
    if (!loaded) return tl::unexpected(loaded.error());
    slam::MapBuilder map(params_);
    map.update(loaded->session.keyframes, loaded->session.poses);
    book_.update(map.grid());
    drawn_ = path;
  }
  return tiles_json(book_.since(since, kDisplayBytes), params_.resolution_m);
}

}  // namespace topo::daemon
