// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace topo::bench {

/// Bytes that operator new has given out in this program and that are not given back.
[[nodiscard]] std::size_t live_bytes();

/// The most there were since reset_peak().
[[nodiscard]] std::size_t peak_bytes();
void reset_peak();

}  // namespace topo::bench
