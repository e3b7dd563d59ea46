// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "core/motion/backing.hpp"
#include "core/motion/breadcrumb_path.hpp"
#include "core/motion/params.hpp"
#include "core/types/robot_limits.hpp"
#include "core/types/stamp.hpp"
#include "core/types/transform.hpp"

namespace topo::motion {

enum class RecoveryPhase : std::uint8_t {
  kNone,
  kWaiting,  ///< an obstacle appeared and may leave by itself, as people do
  kBacking,  ///< back along the breadcrumb path
  kTurning,  ///< towards the continuation of the path
  kEasing,   ///< a little straight back, when it can neither back off nor turn
  kLeaving,  ///< the same straight ahead
  kStuck,    ///< all tries failed; until the goal changes
};

struct RecoveryInput {
  types::Stamp now{};
  std::uint64_t goal_id = 0;
  types::Se2 T_odom_base;
  bool blocked = false;   ///< no arc is possible, or the gate let nothing through
  bool touching = false;  ///< a bumper is pressed or a wheel stalls
  bool refused = false;   ///< the gate let next to nothing of recovery's last motion through
  double turn_rad = 0.0;  ///< from the heading to the continuation of the path
  double blind_s = 0.0;   ///< how long the robot rolls on when the host fails
  double ahead_m = 0.0;   ///< free distance straight ahead
  double seen_behind_m =
      0.0;  ///< straight back over ground observed recently, at most EasingParams::seen_max_m
  const BreadcrumbPath* trail = nullptr;
  const types::RobotLimits* limits = nullptr;
};

struct RecoveryOutput {
  RecoveryPhase phase = RecoveryPhase::kNone;
  types::Twist2 twist;  ///< for kBacking, kEasing, kTurning and kLeaving
  Backing backing = Backing::kNone;
};

/// Recovery from a blocked path: wait, back off, turn free; when neither backing off nor turning is possible,
/// ease a little straight back over ground that the scanner saw, or drive straight ahead in its view; after
/// some tries report kStuck. Every other phase ends after a bounded time.
class Recovery {
 public:
  explicit Recovery(const RecoveryRules& rules = {}) : rules_(rules) {}
  RecoveryOutput step(const RecoveryInput& input);
  /// Time without a task, or with motion impossible for another reason, is not counted as a lack of progress.
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
  int sense_ = 0;                  ///< turn direction after a refusal: 1 left, -1 right; 0: the shorter turn
  bool backs_askew_ = false;       ///< it lacked clearance to turn the breadcrumb path straight behind it
  std::optional<double> eased_m_;  ///< distance in this try; nullopt: not yet
  types::Stamp progress_{};        ///< time of the last progress
  types::Vector2 progress_at_{0.0, 0.0};
  types::Vector2 phase_at_{0.0, 0.0};
  types::Vector2 first_at_{0.0, 0.0};  ///< position of the first try
  std::uint64_t goal_id_ = 0;
  types::Stamp tried_{};   ///< when this try began
  double backed_m_ = 0.0;  ///< in this try
  int tries_ = 0;
  std::uint32_t begun_ = 0;
};

}  // namespace topo::motion
