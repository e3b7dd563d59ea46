// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>

#include "core/analysis/analysis.hpp"
#include "core/goals/goal.hpp"

namespace topo::daemon {

/// The place map as a GeoJSON FeatureCollection (RFC 7946), for any viewer of maps. Coordinates are metres in
/// `map`, x then y, not degrees: its members `frame` and `units` say so. Every feature has `properties.kind`:
/// - "place": Polygon, the outline of its free space (outer ring counter-clockwise, what stands in it as
///   holes), or MultiPolygon, where furniture cuts it into parts, the largest first; properties number,
///   area_m2, clearance_m (greatest), centroid, neighbours (numbers).
/// - "wall": LineString; property length_m.
/// - "goal": Point; properties verdict ("accepted" or why not), place, side, opening_m, opening (point), and
///   number (as in the overview) for the open ones.
/// `origin`: of the analysis's frame, in `map`.
[[nodiscard]] std::string places_geojson(const analysis::Analysis& analysis,
                                         std::span<const goals::Goal> open_goals,
                                         const types::Vector2& origin = {0.0, 0.0});

}  // namespace topo::daemon
