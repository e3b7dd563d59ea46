// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/sim/devices/scan_faults.hpp"

#include <numbers>

namespace topo::sim {

scip::Turn ScanFaults::seen(const scip::Turn& turn, const ScipModelSpec& model) {
  scip::Turn out = turn;
  if (!frozen) {
    kept_.reset();
  } else {
    if (!kept_) kept_ = turn;
    out.beams = kept_->beams;
  }
  if (!mask) return out;
  const double per_step_rad = 2.0 * std::numbers::pi / model.ares;
  for (std::size_t i = 0; i < out.beams.size(); ++i) {
    const double angle_rad = (static_cast<double>(i) + model.amin - model.afrt) * per_step_rad;
    if (angle_rad < mask->from_rad || angle_rad > mask->to_rad) continue;
    out.beams[i].count = 1;
    out.beams[i].echoes[0].range_mm = mask->reads_mm;
  }
  return out;
}

}  // namespace topo::sim
