// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/exploration/sweep_params.hpp"
#include "core/exploration/viewpoint.hpp"
#include "core/goals/goal.hpp"
#include "core/types/map_correction.hpp"
#include "core/types/stamp.hpp"

namespace topo::exploration {

/// Input of a search for viewpoints, borrowed for the call.
struct LookedAt {
  const grid::DenseMap& map;
  std::uint64_t revision = 0;
  double known_m2 = 0.0;  ///< free area of the map
  const grid::TravelField& field;
  std::span<const types::Segment> walls;
  double pocket_reach_m = 0.0;  ///< CandidateParams
};

/// The final sweep of an exploration that has to be complete. When no other goal is reachable, cluttered
/// rooms may still have corners that were never visible, behind gaps too narrow to drive through. One robot
/// of the team looks into each of them once, if their total expected gain is large enough.
class FinalSweep {
 public:
  FinalSweep() = default;
  explicit FinalSweep(const FinalSweepParams& params) : params_(params) {}

  /// Begins another mission.
  void begin(types::Stamp now);
  /// Searches for viewpoints. Does nothing when some are left, the time is over, this revision of the map was
  /// searched, or the last search was less than `again` ago. Costs a tenth of a millisecond for every
  /// frontier without a result that is still true.
  void find(const LookedAt& in, types::Stamp now, types::Duration again);
  /// Other goals have come up: open viewpoints stay open, and the time of the sweep stops.
  void interrupt(types::Stamp now);
  /// The robot was not allowed to go on for `elapsed`, which counts neither as sweep nor as time before it.
  void wait(types::Duration elapsed);
  /// The map was corrected.
  void move(const types::MapCorrection& correction);
  /// Removes viewpoints whose sight cell is known by now; all, when the time is over.
  void settle(const grid::DenseMap& map, types::Stamp now);
  /// The robot has reached a viewpoint. False when the sweep has none with this number.
  bool arrive(std::uint64_t number);
  /// The robot cannot reach a viewpoint. Returns as arrive().
  bool leave(std::uint64_t number);
  /// A team-mate has looked into these openings.
  void share(std::span<const types::Vector2> looked);
  /// Openings into which this robot has looked.
  [[nodiscard]] const std::vector<types::Vector2>& looked() const { return looked_; }
  [[nodiscard]] bool has(std::uint64_t number) const;
  /// Distance to a viewpoint at which it counts as reached.
  [[nodiscard]] double reached_m() const { return params_.reached_m; }
  [[nodiscard]] bool empty() const { return open_.empty(); }
  /// The open viewpoints as goals, and their numbers, in the same order.
  [[nodiscard]] std::vector<goals::Goal> goals() const;
  [[nodiscard]] std::vector<std::uint64_t> numbers() const;

 private:
  struct Open {
    goals::Goal goal;
    std::uint64_t number = 0;
    types::Vector2 sight{0.0, 0.0};  ///< an unknown cell, visible from the goal
  };
  [[nodiscard]] std::vector<Open>::const_iterator find_number(std::uint64_t number) const;
  [[nodiscard]] bool is_over(types::Stamp now) const;
  struct Answer {
    types::Vector2 opening{0.0, 0.0};
    std::size_t cells = 0;
    types::Stamp given{};
    std::optional<exploration::Viewpoint> look;
  };
  [[nodiscard]] std::optional<exploration::Viewpoint> viewpoint_into(const goals::Frontier& frontier,
                                                                     const LookedAt& in, types::Stamp now);
  [[nodiscard]] bool is_same_opening(const types::Vector2& a, const types::Vector2& b) const {
    return (a - b).norm() < params_.same_opening_m;
  }
  [[nodiscard]] bool was_offered(const types::Vector2& opening) const;

  FinalSweepParams params_;
  std::vector<Open> open_;
  std::uint64_t numbered_ = 0;           ///< the newest viewpoint's number
  std::vector<types::Vector2> offered_;  ///< openings taken by this robot or a team-mate; each is inspected
                                         ///< once
  std::vector<types::Vector2> looked_;
  std::vector<Answer> answers_;
  std::uint64_t asked_ = 0;  ///< revision of the map searched last
  types::Stamp begun_{}, asked_at_{};
  std::optional<types::Stamp> sweeps_since_;
  types::Duration swept_{};  ///< in earlier sweeps
};

}  // namespace topo::exploration
