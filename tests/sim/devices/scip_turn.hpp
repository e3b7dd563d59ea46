// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tests/sim/devices/sim_time.hpp"

namespace topo::sim::scip {

struct Echo {
  std::uint32_t range_mm = 0;  ///< or one of the model's codes for "no distance" (PROTOCOLS 10.2)
  std::uint32_t intensity = 0;
};

/// Measurement of one step, nearest echo first.
struct Beam {
  static constexpr std::size_t kMaxEchoes = 3;
  std::uint8_t count = 1;  ///< 1 to kMaxEchoes
  std::array<Echo, kMaxEchoes> echoes{};
};

/// One turn of a sensor's mirror, as input of the device's electronics.
struct Turn {
  SimTime step0{};  ///< time at which the mirror passed step 0, which is the stamp of SCIP (PROTOCOLS section
                    ///< 12)
  std::vector<Beam> beams;  ///< from AMIN to AMAX
};

}  // namespace topo::sim::scip
