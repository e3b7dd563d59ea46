// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/types/se2.hpp"
#include "core/types/stamp.hpp"

namespace topo::exploration {

/// A goal that was given up or visited, and until when it is put off.
struct DeferredGoal {
  types::Vector2 p_map{0.0, 0.0};
  types::Stamp until{};
  int times = 0;  ///< how often it was put off
  std::string why;
  bool visited = false;    ///< a robot was there: what is still open cannot be seen from there
  bool forbidden = false;  ///< as long as the list stands

  static constexpr int kTimesMax = 2;
  /// It does not come back, whatever `until` says.
  [[nodiscard]] bool is_for_good() const { return forbidden || times >= kTimesMax; }
};

/// Goals that did not work out, and those the robot was at. Each comes back after a while, or when nothing
/// else is left; after the second time it stays away.
class DeferredGoals {
 public:
  static constexpr double kSame_m = 0.8;  ///< goals this near are one goal

  void give_up(const types::Vector2& p_map, types::Stamp until, std::string why);
  /// Without a stamp the robot never comes again: "Once a robot has visited what seemed to be an attractive
  /// location, we do not wish to return there" (paper section II-E).
  void visit(const types::Vector2& p_map, std::optional<types::Stamp> until);
  /// Is a goal here put off at this time?
  [[nodiscard]] bool hold(const types::Vector2& p_map, types::Stamp now) const;
  /// Those put off at this time because the robot was there.
  [[nodiscard]] std::vector<types::Vector2> visited(types::Stamp now) const;
  /// Lets all come back that may; false when there is none.
  bool call_back(types::Stamp now);
  void clear() { list_.clear(); }
  /// All that are put off at this time.
  [[nodiscard]] std::vector<DeferredGoal> held(types::Stamp now) const;

 private:
  void note(DeferredGoal goal);

  std::vector<DeferredGoal> list_;
};

}  // namespace topo::exploration
