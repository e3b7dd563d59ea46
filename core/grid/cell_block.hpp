// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace topo::grid {

/// Cells side by side that a pass over a row looks at together: a loop of at most so many over arrays of that
/// size is one of which compilers make vector instructions.
inline constexpr std::size_t kCellBlock = 64;

}  // namespace topo::grid
