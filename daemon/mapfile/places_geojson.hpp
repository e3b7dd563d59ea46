// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>

#include "core/analysis/analysis.hpp"
#include "core/goals/goal.hpp"

namespace topo::daemon {

/// The place map as a GeoJSON FeatureCollection (RFC 7946). Coordinates are metres in `map`, x then y, not
/// degrees, as its members `frame` and `units` state. Every feature has `properties.kind`:
/// - "place": Polygon, the outline of its free space (outer ring counter-clockwise, obstacles as holes), or
///   MultiPolygon when furniture splits it into parts, the largest first; properties number, area_m2,
///   clearance_m (maximum), centroid, neighbours (numbers).
/// - "wall": LineString; property length_m.
/// - "goal": Point; properties verdict ("accepted" or the reason for rejection), place, side, opening_m,
///   opening (point), and for open goals number (as in the overview).
/// `origin`: origin of the analysis's frame, in `map`.
[[nodiscard]] std::string places_geojson(const analysis::Analysis& analysis,
                                         std::span<const goals::Goal> open_goals,
                                         const types::Vector2& origin = {0.0, 0.0});

}  // namespace topo::daemon
