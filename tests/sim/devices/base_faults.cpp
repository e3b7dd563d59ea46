// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/sim/devices/base_faults.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace topo::sim {

void BaseFaults::spoil(arcos::Sip& sip, std::uint64_t number, double track_mm) const {
  constexpr double kPi = std::numbers::pi;
  const double off = number % 2 == 0 ? 0.0 : lie_value;
  const auto whole = [](double value) { return static_cast<int>(std::lround(value)); };
  switch (lie) {
    case StatusLie::kNone:
      return;
    case StatusLie::kSpeed:
      sip.left_mm_s = sip.right_mm_s = whole(lie_value * 1e3);
      return;
    case StatusLie::kTurning:
      sip.right_mm_s = whole(lie_value * track_mm / 2.0);
      sip.left_mm_s = -sip.right_mm_s;
      sip.rotation_ddeg_s = whole(lie_value * 1800.0 / kPi);
      return;
    case StatusLie::kPosition:
      sip.x_mm += whole(off * 1e3);
      return;
    case StatusLie::kHeading:
      sip.heading_counts += whole(off / (2.0 * kPi) * 4096.0);
      return;
  }
}

double BaseFaults::battery_v(double full_v, SimTime now) const {
  return std::max(0.0, full_v - battery_fall_vps * seconds_of(now - battery_since));
}

}  // namespace topo::sim
