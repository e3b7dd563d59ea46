// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "core/plausibility/braking.hpp"
#include "core/plausibility/doubt.hpp"
#include "core/plausibility/match_check.hpp"
#include "core/plausibility/motors_check.hpp"
#include "core/plausibility/obedience.hpp"
#include "core/plausibility/params.hpp"
#include "core/plausibility/picture_check.hpp"

namespace topo::plausibility {

/// What one control period knows. Pointers: the newest of each, borrowed; null when there is none.
struct Evidence {
  types::Stamp now{};
  types::Twist2 commanded;  ///< sent in the period before
  const types::BaseState* base = nullptr;
  const types::Scan* front = nullptr;
  const MatchedMotion* matched = nullptr;
  types::Se2 T_base_laser;
  types::DriveLimits limits;  ///< as the stopping distance uses them
  types::ModelSize model = types::kP3dx;
  bool cleared = false;  ///< by the operator, in this period
  /// Since the period before, the base was heard with its motors off, or after a reset of its controller.
  bool base_released = false;
  bool motors_wanted = false;  ///< by the command that was sent in the period before
};

struct Opinion {
  DoubtSet doubts;
  types::Duration lag{};  ///< from a command to the wheels; 0 until measured
  types::Duration scan_late{}, status_late{};
  double deceleration_mps2 = 0.0;  ///< measured at stops; 0 before the first
};

/// Compares commanded, measured, matched and seen, once a control period (DESIGN "Motion and safety").
///
/// A doubt lasts while its cause lasts and PlausibilityParams::hold longer, and until the robot stands. A
/// doubt that came the third time within a minute lasts until the operator clears it at a standing robot, and
/// so does the one of motors that were switched off: nothing else may switch them on again. A base that
/// disobeys is doubted until its motors are off, its controller was reset, or the operator cleared it at a
/// standing robot, also over new connections and restarts: nothing that the daemon does by itself may feed
/// its watchdog again. Allocates nothing.
class Plausibility {
 public:
  /// `disobeyed`: the base did not obey before the start, and was not released since.
  explicit Plausibility(const PlausibilityParams& params = {}, bool disobeyed = false);

  Opinion judge(const Evidence& evidence);

 private:
  /// One doubt over time.
  struct Held {
    types::Stamp until{};  ///< zero: never
    types::Stamp first{};  ///< of the strikes
    int strikes = 0;
    bool latched = false;
  };

  [[nodiscard]] DoubtSet causes(const Evidence& evidence);
  void judge_status(const Evidence& evidence);
  void hold(std::size_t doubt, bool cause, bool stands, const Evidence& evidence);
  [[nodiscard]] bool rests(const Evidence& evidence) const;
  void release();

  PlausibilityParams params_;
  CommandHistory commands_;
  Obedience obedience_;
  MatchCheck match_;
  MotorsCheck motors_;
  PictureCheck picture_;
  Braking braking_;
  ObedienceOpinion obeys_;
  PictureOpinion sees_;
  bool impossible_ = false, switched_off_ = false;
  types::Odometry last_odometry_;
  types::Stamp last_status_{}, last_scan_{}, last_match_{};
  types::Stamp heard_{};  ///< the newest status, or the start
  DoubtSet present_;
  std::array<Held, kDoubts> held_{};
};

}  // namespace topo::plausibility
