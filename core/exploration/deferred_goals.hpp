// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/exploration/params.hpp"
#include "core/types/map_correction.hpp"
#include "core/types/se2.hpp"
#include "core/types/stamp.hpp"

namespace topo::exploration {

/// A goal that was given up, visited or lost sight of, and is deferred until a given time.
struct DeferredGoal {
  types::Vector2 p_map{0.0, 0.0};
  types::Stamp until{};
  int times = 0;  ///< how often it was deferred
  std::string why{};
  bool visited = false;    ///< a robot was there: what is still open is not visible from there
  bool forbidden = false;  ///< until clear(): after the last visit, or when deferred too often
  int vanished = 0;        ///< how often it was no goal any more while it was pursued

  /// True when the goal never comes back, whatever `until` is.
  [[nodiscard]] bool is_for_good() const { return forbidden; }
};

/// Deferred goals: those given up, those visited, and those that vanish and come back. Each comes back after
/// a while, or when no other goal is left; given up or visited often enough (DeferralParams::times_max) it
/// does not come back.
class DeferredGoals {
 public:
  DeferredGoals() = default;
  explicit DeferredGoals(const DeferralParams& params) : params_(params) {}

  void give_up(const types::Vector2& p_map, types::Stamp until, std::string why);
  /// Without a stamp the goal never comes back: "Once a robot has visited what seemed to be an attractive
  /// location, we do not wish to return there" (paper section II-E).
  void visit(const types::Vector2& p_map, std::optional<types::Stamp> until);
  /// The goal vanished while it was pursued, and others are left. Once is how exploring goes: it was seen
  /// from afar. A goal that came back and vanishes again, as one behind a passage that is closed only while
  /// the robot looks at it, is deferred, so that the robot does not turn between it and another for ever.
  void vanish(const types::Vector2& p_map, types::Stamp until);
  /// True when a goal here is deferred at this time.
  [[nodiscard]] bool hold(const types::Vector2& p_map, types::Stamp now) const;
  /// Goals deferred at this time because of a visit.
  [[nodiscard]] std::vector<types::Vector2> visited(types::Stamp now) const;
  /// Ends the deferral of all goals that may come back; false when there is none.
  bool call_back(types::Stamp now);
  void clear() { list_.clear(); }
  /// The map was corrected.
  void move(const types::MapCorrection& correction) {
    for (DeferredGoal& goal : list_) goal.p_map = correction(goal.p_map);
  }
  /// All goals deferred at this time.
  [[nodiscard]] std::vector<DeferredGoal> held(types::Stamp now) const;

 private:
  std::vector<DeferredGoal>::iterator same_as(const types::Vector2& p_map);
  void note(DeferredGoal goal);

  DeferralParams params_;
  std::vector<DeferredGoal> list_;
};

}  // namespace topo::exploration
