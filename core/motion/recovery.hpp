// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "core/motion/backing.hpp"
#include "core/motion/breadcrumb_path.hpp"
#include "core/types/robot_limits.hpp"
#include "core/types/stamp.hpp"
#include "core/types/transform.hpp"

namespace topo::motion {

enum class RecoveryPhase : std::uint8_t {
  kNone,
  kWaiting,  ///< something appeared in the way and may go by itself, as people do
  kBacking,  ///< along the way it came
  kTurning,  ///< to where the path goes on
  kEasing,   ///< a little straight back, where it can neither back off nor turn, to where it can
  kLeaving,  ///< the same straight on
  kStuck,    ///< nothing of it helped; until the goal is another one
};

struct RecoveryRules {
  types::Duration wait = std::chrono::milliseconds(2500);
  types::Duration no_progress = std::chrono::seconds(8);  ///< as good as blocked
  double progress_m = 0.15;
  double back_m = 0.5;       ///< at most, with what the watchdog lets it roll
  double leave_m = 0.4;      ///< at most
  double ease_m = 0.08;      ///< more with each try
  int tries = 3;             ///< then stuck
  double forgotten_m = 1.0;  ///< so far from where it was, the tries begin anew
};

struct RecoveryInput {
  types::Stamp now{};
  std::uint64_t goal_id = 0;
  types::Se2 T_odom_base;
  bool blocked = false;        ///< no way leads on, or the gate let nothing through
  bool touching = false;       ///< a bumper is pressed or a wheel stalls
  bool refused = false;        ///< the gate let next to nothing of the recovery's own last motion through
  double turn_rad = 0.0;       ///< from the nose to where the path goes on
  double blind_s = 0.0;        ///< what the robot rolls on for when the host dies
  double ahead_m = 0.0;        ///< free straight on
  double seen_behind_m = 0.0;  ///< straight back, where the scanner looked lately, at most kSeenBehind_m
  const BreadcrumbPath* trail = nullptr;
  const types::RobotLimits* limits = nullptr;
};

struct RecoveryOutput {
  RecoveryPhase phase = RecoveryPhase::kNone;
  types::Twist2 twist;  ///< for kBacking, kEasing, kTurning and kLeaving
  Backing backing = Backing::kNone;
};

/// What to do when the way is blocked: wait, back off, turn free, where neither can be done ease a little
/// straight back over ground that the scanner saw, or go straight on, which it watches over, and after some
/// tries say that it is stuck. Every phase ends after a bounded time.
class Recovery {
 public:
  /// As far as it wants to know: more than it rolls on for when the host dies while it eases.
  static constexpr double kSeenBehind_m = 0.15;

  explicit Recovery(const RecoveryRules& rules = {}) : rules_(rules) {}
  RecoveryOutput step(const RecoveryInput& input);
  /// Time in which nothing was to be done, or could be for another reason, is not held against the goal.
  void pause(types::Stamp now);
  [[nodiscard]] std::uint32_t begun() const { return begun_; }

 private:
  void enter(RecoveryPhase phase, const RecoveryInput& in);
  void begin(const RecoveryInput& in);
  void watch(const RecoveryInput& in);
  void note_progress(const RecoveryInput& in);
  RecoveryOutput back(const RecoveryInput& in);
  RecoveryOutput turn(const RecoveryInput& in);
  RecoveryOutput ease(const RecoveryInput& in);
  RecoveryOutput leave(const RecoveryInput& in);
  void turn_other_way_when_refused(double angle_rad, const RecoveryInput& in);
  [[nodiscard]] types::Twist2 back_twist(const RecoveryInput& in) const;

  RecoveryRules rules_;
  RecoveryPhase phase_ = RecoveryPhase::kNone;
  types::Stamp since_{};           ///< of the phase
  types::Stamp blocked_{};         ///< since when; zero: not
  types::Stamp refused_{};         ///< since when; zero: not
  int sense_ = 0;                  ///< of a turn that was refused the shorter way: 1 left, -1 right
  bool backs_askew_ = false;       ///< it had no room to bring the trail straight behind it
  std::optional<double> eased_m_;  ///< how far in this try; nothing: not yet
  types::Stamp progress_{};        ///< when it last got on
  types::Vector2 progress_at_{0.0, 0.0};
  types::Vector2 phase_at_{0.0, 0.0};
  types::Vector2 first_at_{0.0, 0.0};  ///< of the first try
  std::uint64_t goal_id_ = 0;
  types::Stamp tried_{};   ///< when this try began
  double backed_m_ = 0.0;  ///< in this try
  int tries_ = 0;
  std::uint32_t begun_ = 0;
};

}  // namespace topo::motion
