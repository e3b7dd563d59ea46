// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace topo::pioneer {

/// Calls of operator new in this program so far.
std::size_t allocations();

}  // namespace topo::pioneer
