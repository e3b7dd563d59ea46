// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace topo::grid {

/// Number of adjacent cells that a pass over a row processes together: compilers vectorise a loop with this
/// bound over arrays of this size.
inline constexpr std::size_t kCellBlock = 64;

}  // namespace topo::grid
