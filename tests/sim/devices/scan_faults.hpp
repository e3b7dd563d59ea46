// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "tests/sim/devices/scip_models.hpp"
#include "tests/sim/devices/scip_turn.hpp"

namespace topo::sim {

/// Every beam of a sector reads the same, whatever is there.
struct Mask {
  double from_rad = 0.0, to_rad = 0.0;  ///< counter-clockwise from straight ahead
  std::uint32_t reads_mm = 0;           ///< or one of the model's codes
};

/// Faults of a scanner that measures something else than what is there, in form and in time.
struct ScanFaults {
  bool frozen = false;  ///< one picture with new stamps
  std::optional<Mask> mask;

  /// The turn as the scanner believes it.
  scip::Turn seen(const scip::Turn& turn, const ScipModelSpec& model);

 private:
  std::optional<scip::Turn> kept_;
};

}  // namespace topo::sim
