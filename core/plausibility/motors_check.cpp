// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/plausibility/motors_check.hpp"

#include <utility>

namespace topo::plausibility {

void MotorsCheck::want(types::Stamp now, bool on) {
  if (!on) wanted_since_ = {};
  if (on && wanted_since_ == types::Stamp{}) wanted_since_ = now;
}

bool MotorsCheck::judge(const types::BaseState& state, bool first) {
  const bool were_on = std::exchange(on_, state.motors_enabled) && !first;
  if (!were_on || on_ || state.stop_button) return false;
  return wanted_since_ != types::Stamp{} && state.arrival - wanted_since_ >= params_.wanted_for;
}

}  // namespace topo::plausibility
