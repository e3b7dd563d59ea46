// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace topo::grid {

/// Adjacent cells in one row of a map, by index: [first, end).
struct CellRun {
  std::uint32_t first = 0;
  std::uint32_t end = 0;
  friend bool operator==(const CellRun&, const CellRun&) = default;
};

}  // namespace topo::grid
