// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "core/types/result.hpp"

namespace topo::bench {

struct CalibrateCommand {
  std::uint64_t seeds = 5;
  bool json = false;
};

/// `topobench calibrate`: prints what setup and calibration make of the robots of that many seeds, with the
/// worst errors. An error when one of them is worse than it must be, or a robot was not calibrated.
types::Status run_calibrate(const CalibrateCommand& command);

}  // namespace topo::bench
