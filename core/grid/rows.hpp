// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace topo::grid {

/// Rows [first, end) of a map, counted from its lowest.
struct Rows {
  std::size_t first = 0, end = 0;

  [[nodiscard]] bool empty() const { return first >= end; }
  friend bool operator==(const Rows&, const Rows&) = default;
};

}  // namespace topo::grid
