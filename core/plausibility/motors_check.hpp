// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/plausibility/params.hpp"
#include "core/types/base_state.hpp"

namespace topo::plausibility {

/// Notices motors that go off although the host wants them on: by the robot's MOTORS button, or by the
/// firmware. The STOP button, which switches them off as well, is an e-stop.
class MotorsCheck {
 public:
  explicit MotorsCheck(const MotorsParams& params = {}) : params_(params) {}

  /// Every control period: whether the command of the period before wanted them on.
  void want(types::Stamp now, bool on);
  /// A new status; `first`: of its connection, at whose beginning they are off. True when they were switched
  /// off.
  bool judge(const types::BaseState& state, bool first);

 private:
  MotorsParams params_;
  types::Stamp wanted_since_{};  ///< zero: they are not wanted
  bool on_ = false;              ///< by the last status
};

}  // namespace topo::plausibility
