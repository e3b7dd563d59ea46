// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/sim/raster.hpp"

#include <algorithm>

namespace topo::sim {

double Raster::area_m2() const {
  const auto set = std::count_if(cells.begin(), cells.end(), [](std::uint8_t c) { return c != 0; });
  return static_cast<double>(set) * resolution_m * resolution_m;
}

}  // namespace topo::sim
