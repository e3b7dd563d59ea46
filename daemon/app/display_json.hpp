// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "core/types/scan.hpp"
#include "core/types/se2.hpp"
#include "daemon/app/tile_book.hpp"
#include "daemon/control/json_rpc.hpp"

namespace topo::daemon {

/// Cells in one answer: what a client has not read is kept up to 1 MB (ControlServer).
inline constexpr std::size_t kDisplayBytes = 128'000;

/// An answer of map.tiles (MapView::tiles); the next call's `since` is in it.
Json tiles_json(const TileBook::Part& part, double resolution_m);

/// A way as [[x, y], ...], to the centimetre: every n-th place, and the newest, at most about 300.
Json trail_json(const std::vector<types::Vector2>& places_map);

/// Where a scan's rays ended, in map: {"cm": [x, y, x, y, ...]}, whole centimetres, of every n-th beam, at
/// most about 90 of them.
Json scan_json(const types::Scan& scan, const types::Se2& T_map_laser);

}  // namespace topo::daemon
