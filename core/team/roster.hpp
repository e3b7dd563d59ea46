// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <map>
#include <vector>

#include "core/team/status_message.hpp"

namespace topo::team {

/// A robot's swing radius, and how far it gets from when it said where it is until it is seen there.
inline constexpr double kMateRadius_m = 0.75;
/// Who was heard of longer ago is somewhere else.
inline constexpr types::Duration kPlaceAgeMax = std::chrono::seconds(2);

struct RosterParams {
  double silent_s = 10.0;    ///< not heard of for so long: its goal is free
  double missing_s = 240.0;  ///< nobody waits for it at home any more
  double unable_s = 10.0;    ///< lost or stopped for so long: its goal is free
  double stuck_s = 30.0;     ///< claims a goal and stays for so long where it is: its goal is free
  double progress_m = 0.5;   ///< less than this is staying
};

/// The team as one robot knows it. Old and repeated messages change nothing, and neither does the order in
/// which those of different robots come. A robot that was silent may count anew: it was started again. Words
/// are judged by when they came here: robots' clocks need not agree.
class Roster {
 public:
  explicit Roster(const RosterParams& params = {}) : params_(params) {}

  /// False: old or repeated.
  bool take(const StatusMessage& message, types::Stamp now);

  /// True when no team-mate was ever heard.
  [[nodiscard]] bool empty() const { return mates_.empty(); }
  /// Those heard of lately, by id: where they are is known. Good until the next take().
  [[nodiscard]] std::vector<const StatusMessage*> heard(types::Stamp now) const;
  /// How long ago one of those was heard of.
  [[nodiscard]] types::Duration age_of(const StatusMessage& message, types::Stamp now) const {
    return now - mates_.at(message.robot).heard;
  }
  /// Of those the ones whose bids and claims count: neither home nor, for a while now, unable or stuck.
  [[nodiscard]] std::vector<const StatusMessage*> counted(types::Stamp now) const;
  /// Where those are that can go out of the way, heard of within kPlaceAgeMax: counted ones, and those that
  /// wait at home.
  [[nodiscard]] std::vector<types::Vector2> going_at(types::Stamp now) const;
  /// Was anybody, silent or not, still out when last heard of?
  [[nodiscard]] bool any_at_work() const;
  /// Is everybody that was ever heard of home, or missing? Who is only out of reach may still want past.
  [[nodiscard]] bool all_home(types::Stamp now) const;

 private:
  struct Mate {
    StatusMessage message;
    types::Stamp heard{};
    types::Stamp able_at{};      ///< when it last was
    types::Stamp progress_at{};  ///< when it last moved, or had no goal
    types::Vector2 stood{0.0, 0.0};
  };
  [[nodiscard]] bool is_silent(const Mate& mate, types::Stamp now) const;
  [[nodiscard]] bool counts(const Mate& mate, types::Stamp now) const;

  RosterParams params_;
  std::map<std::uint16_t, Mate> mates_;
};

}  // namespace topo::team
