// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace topo::test {

/// Calls of operator new in this program so far. Counted in a file of its own: a compiler that sees both
/// sides of a replaced operator takes malloc and delete for a mismatch.
[[nodiscard]] std::uint64_t allocations();

}  // namespace topo::test
