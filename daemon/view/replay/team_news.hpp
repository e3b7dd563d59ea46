// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "daemon/view/replay/story.hpp"

namespace topo::daemon {

/// What changed in the team from one state of a log to the next, as events:
///
///   "mate"        a "robot" came into reach or went out of it, its map was joined, it set out for a goal
///                 ("x_m", "y_m"), or is able to explore or no longer: "what" says which
///   "team_word"   the robots that have acknowledged this robot's "order" until then, and those that refused
///
/// A log has states alone: these events follow from them. Pure.
[[nodiscard]] std::vector<StoryLine> team_news(const std::vector<StoryLine>& states);

/// The story with its team's news among the events.
[[nodiscard]] Story with_team_news(Story story);

}  // namespace topo::daemon
