// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <map>
#include <vector>

#include "core/team/status_message.hpp"

namespace topo::team {

/// What counts of team-mates' messages. No source is recorded for the values that name none.
struct RosterParams {
  double silent_s = 10.0;    ///< no message for so long: its goal is free
  double missing_s = 240.0;  ///< no message for so long: no longer waited for at home
  double unable_s = 10.0;    ///< lost or stopped for so long: its goal is free
  double stuck_s = 30.0;     ///< claims a goal but does not move for so long: its goal is free
  double progress_m = 0.5;   ///< a shorter move counts as none
  types::Duration place_age_max = std::chrono::seconds(2);  ///< an older position is out of date
  /// A robot's swing radius plus the distance it travels between reporting its position and being seen.
  double mate_radius_m = 0.75;
  double at_start_m = 0.6;  ///< a robot within this distance of a start leaves no room there for another
};

/// The team as known to one robot. Old and repeated messages change nothing, nor does the order in which
/// messages of different robots arrive. A robot that was silent may restart its count: it was restarted. The
/// age of a message is measured from its arrival here: the robots' clocks need not agree.
class Roster {
 public:
  explicit Roster(const RosterParams& params = {}) : params_(params) {}
  [[nodiscard]] const RosterParams& params() const { return params_; }

  /// Returns false for an old or repeated message.
  bool take(const StatusMessage& message, types::Stamp now);

  /// True when no team-mate was ever heard from.
  [[nodiscard]] bool empty() const { return mates_.empty(); }
  /// The messages of the team-mates that are not silent, by id: their positions are known. Valid until the
  /// next take().
  [[nodiscard]] std::vector<const StatusMessage*> heard(types::Stamp now) const;
  /// The newest messages of the team-mates that were heard within `missing_s`, by id. Valid as heard().
  [[nodiscard]] std::vector<const StatusMessage*> not_missing(types::Stamp now) const;
  /// The age of one of these messages.
  [[nodiscard]] types::Duration age_of(const StatusMessage& message, types::Stamp now) const {
    return now - mates_.at(message.robot).heard;
  }
  /// Those of heard() whose bids and claims count: mission not over, and not unable or stuck for some time.
  [[nodiscard]] std::vector<const StatusMessage*> counted(types::Stamp now) const;
  /// Positions of the team-mates that can give way, heard from within place_age_max: able counted ones, and
  /// those that wait at home.
  [[nodiscard]] std::vector<types::Vector2> going_at(types::Stamp now) const;
  /// True when the mission of any team-mate, silent or not, was not over at its last message.
  [[nodiscard]] bool any_at_work() const;
  /// True when the mission of every team-mate is over, or the team-mate is missing. One that is only out of
  /// reach may still need to pass.
  [[nodiscard]] bool all_home(types::Stamp now) const;

 private:
  struct Mate {
    StatusMessage message;
    types::Stamp heard{};
    types::Stamp able_at{};      ///< when it was last able
    types::Stamp progress_at{};  ///< when it last moved, or had no goal
    types::Vector2 stood{0.0, 0.0};
  };
  [[nodiscard]] bool is_silent(const Mate& mate, types::Stamp now) const;
  [[nodiscard]] std::vector<const StatusMessage*> heard_within(types::Stamp now, double within_s) const;
  [[nodiscard]] bool counts(const Mate& mate, types::Stamp now) const;

  RosterParams params_;
  std::map<std::uint16_t, Mate> mates_;
};

}  // namespace topo::team
