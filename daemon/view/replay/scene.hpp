// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "daemon/view/replay/story.hpp"

// What a page shows of a story at a time: values in the form in which a live daemon gives them. Pure
// functions of story and time, so that it does not matter by which way the time was reached.
namespace topo::daemon {

/// As the answer to "status", of the last state; the place in between two states is on the way between them.
[[nodiscard]] Json status_at(const Story& story, double t_s, const std::string& robot);
/// As the answer to "goals": the goal, and the decision for it. Others are not in a log.
[[nodiscard]] Json goals_at(const Story& story, double t_s);
/// As the answer to "areas": those that were drawn and not withdrawn.
[[nodiscard]] Json areas_at(const Story& story, double t_s);
/// {"events": the last 60, "known_m2": [[t_s, m2], ...] until then, at most about 300}.
[[nodiscard]] Json past_at(const Story& story, double t_s);
/// The number of keyframes that the map had.
[[nodiscard]] std::size_t keyframes_at(const Story& story, double t_s);

}  // namespace topo::daemon
