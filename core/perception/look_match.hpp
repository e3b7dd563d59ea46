// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/perception/scan_look.hpp"

namespace topo::perception {

/// How a sensor moved from one look to the next.
struct LookMatch {
  types::Se2 T_before_now;
  double explained = 0.0;  ///< part of the compared beams that fits within 0.1 m
};

/// From what stands: beams are laid onto the lines that the look before saw in their directions (point to
/// line, Chen and Medioni 1992, with the beam as correspondence: Blais and Levine 1995), and what does not
/// fit counts little. Wheels that slip have dead reckoning turn a whole room; where the room says nothing,
/// along a corridor, the guess holds. About 300 beams are compared, at most ten times.
LookMatch match_looks(const ScanLook& before, const ScanLook& now, const types::Se2& guess);

}  // namespace topo::perception
