// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/slam/localise.hpp"

namespace topo::slam {

/// Why a place that was found in a map is a proposal; kNone: it is a fact. The robot may have been carried
/// since the map was made.
enum class PlaceDoubt : std::uint8_t {
  kNone,
  kLooksAlike,     ///< another place fits nearly as well
  kAlongAWall,     ///< the scan leaves open where along a wall it is
  kNotSearched,    ///< the map is too large to be searched as a whole
  kDroppedBefore,  ///< a place in this map did not match in the first metres
  kAreaLimits,     ///< a wrong place would lead through forbidden areas
  kSmallMap,       ///< it shows too little of the building: what looks alike may not be in it
};

/// What is known beside scan and map.
struct PlacementCase {
  std::optional<types::Se2> given;  ///< pose from the operator
  bool has_area_limits = false;
  bool dropped_before = false;
  std::uint16_t robot = 0;  ///< whose place it is: a map holds keyframes of team-mates, too
};

struct PlacementParams {
  /// Fewer keyframes are too small a map. 30 are 12 m of way (KeyframeParams::travel_m), more than one room.
  std::size_t keyframes_min = 30;
  LocaliseParams anywhere;
  /// Around the end of the session's path, where a robot is that was only restarted: it rolled on until the
  /// firmware's watchdog or topometric-estop stopped it.
  LocaliseParams near_end = [] {
    LocaliseParams params;
    params.window = {3.0, 1.0};
    params.guess_sigma_m = 1.5;
    params.guess_sigma_rad = 0.5;
    return params;
  }();
};

/// A robot's place in a session's map.
struct Placement {
  Localisation place;
  PlaceDoubt doubt = PlaceDoubt::kNone;
  std::vector<Match> others;  ///< places that fit nearly as well; of a given pose too, for the first metres
  [[nodiscard]] bool found() const { return place.found(); }
  [[nodiscard]] bool is_fact() const { return found() && doubt == PlaceDoubt::kNone; }
};

/// The gravest doubt about a place. `searched`: outcome of the search of the whole map, kNone where the
/// operator gave the pose. `keyframes`: of the map.
[[nodiscard]] PlaceDoubt doubt_about(LocaliseRefusal searched, std::size_t keyframes,
                                     const PlacementCase& known, const PlacementParams& params = {});

/// Looks for the scan near the given pose, else in the whole map; where several places fit, that near the end
/// of the robot's own path is proposed. Pure function.
[[nodiscard]] Placement place_in(const Session& session, const Cloud& cloud, const PlacementCase& known,
                                 const MapperParams& mapper, const PlacementParams& params = {});

/// The reason of a doubt as the end of a sentence; empty for kNone.
[[nodiscard]] std::string_view to_text(PlaceDoubt doubt);
/// One sentence for the operator: the place, or why there is none; of a proposal also the other places and
/// the reason.
[[nodiscard]] std::string describe(const Placement& placement);

}  // namespace topo::slam
