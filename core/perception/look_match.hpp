// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/perception/params.hpp"
#include "core/perception/scan_look.hpp"

namespace topo::perception {

/// Motion of a sensor between two sweeps.
struct LookMatch {
  types::Se2 T_before_now;
  double explained = 0.0;  ///< fraction of the compared beams that fits within LookMatchParams::fits_m
};

/// Computed from static surroundings: beams are aligned with the lines that the sweep before measured in
/// their directions (point to line, Chen and Medioni 1992, with the beam as correspondence: Blais and Levine
/// 1995). Beams that do not fit have little weight. With slipping wheels, dead reckoning alone would make a
/// whole room turn; where the room gives no constraint, along a corridor, the guess holds.
LookMatch match_looks(const ScanLook& before, const ScanLook& now, const types::Se2& guess,
                      const LookMatchParams& params);

}  // namespace topo::perception
