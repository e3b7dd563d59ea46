// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "core/types/se2.hpp"
#include "daemon/control/json_rpc.hpp"
#include "daemon/session/map_history.hpp"

namespace topo::daemon {

/// A line of a mission log (app/mission_log.hpp).
struct StoryLine {
  double t_s = 0.0;  ///< since the story's beginning
  Json json;
};

/// What a mission log tells, in order of time.
struct Story {
  std::vector<StoryLine> states;  ///< about one a second
  std::vector<StoryLine> events;
  std::size_t unread = 0;  ///< lines that are none: damaged, or of another kind

  [[nodiscard]] double length_s() const {
    return std::max(states.empty() ? 0.0 : states.back().t_s, events.empty() ? 0.0 : events.back().t_s);
  }
};

/// A member of an object; null when there is none.
[[nodiscard]] const Json& member_of(const Json& object, const char* name);

/// A member that is a number, of an object; nothing when there is none. Times may be beyond what a client may
/// say (kGreatestReal).
[[nodiscard]] std::optional<double> number_in(const Json& object, const char* name);

/// The member "pose" of an object; nothing when there is none.
[[nodiscard]] std::optional<types::Se2> pose_in(const Json& object);
[[nodiscard]] Json pose_json(const types::Se2& pose);

/// How many lines there are until a time, that included.
[[nodiscard]] std::size_t lines_until(const std::vector<StoryLine>& lines, double t_s);

/// A time between two states.
struct Moment {
  const StoryLine* now = nullptr;  ///< the state that holds; null: there is none yet
  const StoryLine* next =
      nullptr;         ///< the one after it; null: there is none, or what was in between is not known
  double share = 0.0;  ///< of the way from one to the other

  /// A place that is seen to be on its way.
  [[nodiscard]] types::Se2 between(const types::Se2& from, const types::Se2& to) const {
    return types::interpolate(from, to, share);
  }
};
[[nodiscard]] Moment moment_at(const Story& story, double t_s);

/// The number of keyframes, of all robots, that the map had by a state.
[[nodiscard]] std::size_t keyframes_of(const Json& state);

/// A story in which each state has that number. Older logs have the robot's own keyframes alone: then those
/// of mates were in the map that came, in its order, before the robot's next.
[[nodiscard]] Story with_all_keyframes(Story story, const MapHistory& history);

/// Reads a log. What is no line of one is counted, and left out. Safe for untrusted input.
[[nodiscard]] Story parse_story(std::string_view text);

/// The part of a log that is about one map: a daemon may begin several, and the number of keyframes falls
/// then. `begun_s`: when the journal of the map was begun, seconds since 1970; nothing: the last of them.
[[nodiscard]] Story of_map(Story story, std::optional<std::int64_t> begun_s);

/// What the keyframes alone tell when there is no log: where the robot was that made the first of them. A
/// robot that stood is not waited for.
[[nodiscard]] Story story_of(const MapHistory& history);

/// Seconds since 1970 of 2026-01-02T03:04:05Z; nothing for another text.
[[nodiscard]] std::optional<std::int64_t> seconds_of(std::string_view utc);

}  // namespace topo::daemon
