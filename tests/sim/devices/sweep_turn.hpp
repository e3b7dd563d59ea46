// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tests/sim/devices/scip_turn.hpp"
#include "tests/sim/laser.hpp"

namespace topo::sim {

/// What the electronics of a sensor with single echoes get of a sweep. `turn` is reused.
inline void fill_turn(const Sweep& sweep, scip::Turn& turn) {
  turn.step0 = sweep.step0;
  turn.beams.resize(sweep.range_mm.size());
  for (std::size_t i = 0; i < turn.beams.size(); ++i) {
    turn.beams[i].count = 1;
    turn.beams[i].echoes[0] = {sweep.range_mm[i], sweep.intensity[i]};
  }
}

}  // namespace topo::sim
