// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "core/types/robot_limits.hpp"
#include "core/types/se2.hpp"
#include "core/types/transform.hpp"

namespace topo::types {

/// Corners in order, in map; the last is joined to the first.
using Polygon = std::vector<types::Vector2>;

/// Where the robot may be (stairs and glass that no laser sees). In metres in map, whose origin is the start
/// or that of a loaded map.
struct AreaLimits {
  std::optional<Polygon> keep_in;  ///< must not be left; nothing: anywhere
  std::vector<Polygon> keep_out;   ///< must not be entered

  [[nodiscard]] bool empty() const { return !keep_in && keep_out.empty(); }
};

/// May the point be visited? A point on an edge may not.
bool allows(const AreaLimits& limits, const types::Vector2& p_map);

/// How far the outline sticks out of what is allowed, metres; 0 when all of it is allowed.
double intrusion_m(const AreaLimits& limits, const types::Se2& T_map_base, const Footprint& footprint);

/// How long a robot may go on at `twist` until its outline leaves what is allowed; kNever_s (infinity) when
/// it does not within `until_s`. Where it is out already (the map was corrected, or somebody carried it), the
/// time until it would be further out than before: it may come in, and nothing else.
double area_free_time_s(const AreaLimits& limits, const types::Se2& T_map_base, const types::Twist2& twist,
                        const Footprint& footprint, double until_s);

}  // namespace topo::types
