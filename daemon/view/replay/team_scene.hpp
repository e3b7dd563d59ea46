// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "daemon/view/replay/story.hpp"

// The team of a story as its robot knew it at a time, in the form in which a live daemon tells it. Pure
// functions of story and time, as those of scene.hpp.
namespace topo::daemon {

/// Where a robot made its newest keyframe in a map.
struct LastPlace {
  std::uint16_t robot = 0;
  types::Se2 T_map_base;
  std::size_t keyframe = 0;  ///< number in the map
};

/// As the answer to "team". Between two states a mate is on its way from where it was to where it will be,
/// and its age that of its newest word then.
[[nodiscard]] Json team_at(const Story& story, double t_s);

/// The team with mates of whose place a log says nothing (an old one, or none) where their newest keyframes
/// are, "by_map", as old as these were in the map ("age_s").
[[nodiscard]] Json with_last_places(Json team, const Story& story, double t_s,
                                    std::span<const LastPlace> mates);

}  // namespace topo::daemon
