// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "core/types/se2.hpp"
#include "core/types/stamp.hpp"

namespace topo::pipeline {

/// A goal that was put off, and until when.
struct GivenUp {
  types::Vector2 p_map{0.0, 0.0};
  types::Stamp until{};
  int times = 0;  ///< how often it was given up
  std::string why;
};

/// Goals that did not work out. Each comes back after a while, or when nothing else is left; after the second
/// time it stays away.
class GivenUpGoals {
 public:
  static constexpr double kSame_m = 0.8;  ///< goals this near are one goal
  static constexpr int kTimesMax = 2;
  /// Why a goal is put off that a robot was at: what is still open cannot be seen from there.
  static constexpr const char* kVisited = "visited";

  void add(const types::Vector2& p_map, types::Stamp until, std::string why);
  /// Is a goal here put off at this time?
  [[nodiscard]] bool hold(const types::Vector2& p_map, types::Stamp now) const;
  /// Those put off at this time, for this reason.
  [[nodiscard]] std::vector<types::Vector2> held_for(const std::string& why, types::Stamp now) const;
  /// Lets all come back that may; false when there is none.
  bool call_back(types::Stamp now);
  void clear() { list_.clear(); }
  [[nodiscard]] const std::vector<GivenUp>& list() const { return list_; }

 private:
  std::vector<GivenUp> list_;
};

}  // namespace topo::pipeline
