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
#include "core/types/stamp.hpp"

namespace topo::exploration {

/// Borrowed for the call.
struct LookedAt {
  const grid::DenseMap& map;
  std::uint64_t revision = 0;
  double known_m2 = 0.0;  ///< free area of the map
  const grid::TravelField& field;
  std::span<const types::Segment> walls;
};

/// The last sweep of an exploration that is to be complete. When no other goal can be gone for now, cluttered
/// rooms may still have corners that were never in sight, behind gaps through which one cannot drive: each is
/// looked into, once by one robot of the team, if all of them together promise enough.
class FinalSweep {
 public:
  FinalSweep() = default;
  explicit FinalSweep(const FinalSweepParams& params) : params_(params) {}

  /// Another mission.
  void begin(types::Stamp now);
  /// Looks for looks, unless some are left, or the time is over, or this map was asked already, or one was
  /// less than `again` ago: it costs a tenth of a millisecond for every frontier of which it was not asked in
  /// the last half minute.
  void find(const LookedAt& in, types::Stamp now, types::Duration again);
  /// Other goals are there again: what is open stays open, and the sweep's time stands still.
  void interrupt(types::Stamp now);
  /// Takes away those whose sight is known by now; all, when the time is over.
  void settle(const grid::DenseMap& map, types::Stamp now);
  /// The robot was at a viewpoint. False when the sweep has none of that number.
  bool arrive(std::uint64_t number);
  /// It could not get there; the same.
  bool leave(std::uint64_t number);
  /// A mate has looked into these openings.
  void share(std::span<const types::Vector2> looked);
  /// Openings that this robot has looked into.
  [[nodiscard]] const std::vector<types::Vector2>& looked() const { return looked_; }
  [[nodiscard]] bool has(std::uint64_t number) const;
  /// How near the robot has to come to a viewpoint.
  [[nodiscard]] double reached_m() const { return params_.reached_m; }
  [[nodiscard]] bool empty() const { return open_.empty(); }
  /// The open viewpoints as goals, and their numbers, in the same order.
  [[nodiscard]] std::vector<goals::Goal> goals() const;
  [[nodiscard]] std::vector<std::uint64_t> numbers() const;

 private:
  struct Open {
    goals::Goal goal;
    std::uint64_t number = 0;
    types::Vector2 sight{0.0, 0.0};  ///< unknown, and in sight from the goal
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
  [[nodiscard]] bool was_offered(const types::Vector2& opening) const;

  FinalSweepParams params_;
  std::vector<Open> open_;
  std::uint64_t numbered_ = 0;           ///< the newest viewpoint's number
  std::vector<types::Vector2> offered_;  ///< openings, here or to a mate; each is looked into once
  std::vector<types::Vector2> looked_;
  std::vector<Answer> answers_;
  std::uint64_t asked_ = 0;  ///< revision of the map
  types::Stamp begun_{}, asked_at_{};
  std::optional<types::Stamp> sweeps_since_;
  types::Duration swept_{};  ///< in sweeps before
};

}  // namespace topo::exploration
