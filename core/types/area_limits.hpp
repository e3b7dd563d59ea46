// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "core/types/robot_limits.hpp"
#include "core/types/se2.hpp"
#include "core/types/transform.hpp"

namespace topo::types {

/// Corners in order, in the map frame; an edge joins the last to the first.
using Polygon = std::vector<types::Vector2>;

/// What an area that an operator draws is for.
enum class AreaKind : std::uint8_t {
  kKeepOut,    ///< no wheel enters it
  kHereFirst,  ///< goals in it come before all others
};
std::string_view to_text(AreaKind kind);
/// Nothing for another text.
std::optional<AreaKind> area_kind_of(std::string_view text);

/// True for a point inside, or at most `beside_m` from an edge.
bool is_within(const Polygon& polygon, const types::Vector2& p_map, double beside_m);

/// Area in which the robot may be; keeps it away from stairs and glass, which no laser detects. Metres in the
/// map frame, whose origin is the start pose or that of a loaded map.
struct AreaLimits {
  std::optional<Polygon> keep_in;  ///< must not be left; nullopt: no limit
  std::vector<Polygon> keep_out;   ///< must not be entered

  [[nodiscard]] bool empty() const { return !keep_in && keep_out.empty(); }
  friend bool operator==(const AreaLimits&, const AreaLimits&) = default;
};

/// True when the point may be visited; false for a point on an edge.
bool allows(const AreaLimits& limits, const types::Vector2& p_map);

/// Greatest depth of the outline outside the allowed area, in metres; 0 when all of the outline is allowed.
double intrusion_m(const AreaLimits& limits, const types::Se2& T_map_base, const Footprint& footprint);

/// Seconds for which the robot can continue at `twist` until its outline leaves the allowed area; kNever_s
/// (infinity) when it does not within `until_s`. When the outline is already outside (the map was corrected,
/// or the robot was carried), the time until the intrusion grows: only motion that does not deepen it is
/// allowed.
double area_free_time_s(const AreaLimits& limits, const types::Se2& T_map_base, const types::Twist2& twist,
                        const Footprint& footprint, double until_s);

}  // namespace topo::types
