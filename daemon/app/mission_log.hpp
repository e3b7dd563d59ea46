// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "core/types/stamp.hpp"
#include "daemon/control/json_rpc.hpp"
#include "daemon/threads/log_lines.hpp"

namespace topo::daemon {

/// Main's side of the mission log. Each line is an object: "t_s" since the daemon's start, "utc" (ISO 8601),
/// and
///
///   "kind": "state"   once a second: pose, velocity, mission, goal with reason, doubts, battery, known area,
///                     keyframes of the map, the robot's own and all, and for each robot of the team what is
///                     known of its link and of its place and goal in this robot's map; "in_team": this
///                     robot's number, its newest order to mates and their acknowledgements, its link's fault
///   "kind": "event"   what subscribers are told ("event": "mission", "decision", "team_order", ...)
///
/// Main only.
class MissionLog {
 public:
  /// `begin`: the daemon's start.
  MissionLog(LogLines& lines, types::Stamp begin) : lines_(lines), begin_(begin) {}

  void note_event(types::Stamp now, const Json& event);
  /// True when a second has gone by since the last state.
  [[nodiscard]] bool is_due(types::Stamp now) const { return now >= next_state_; }
  /// `status` and `team` as the control socket answers them.
  void note_state(types::Stamp now, const Json& status, const Json& team);

  /// Lines for which there was no room while the disk did not take any.
  [[nodiscard]] std::uint64_t lost() const { return lost_; }

 private:
  void add(types::Stamp now, Json line);

  LogLines& lines_;
  types::Stamp begin_, next_state_{};
  std::uint64_t lost_ = 0;
};

}  // namespace topo::daemon
