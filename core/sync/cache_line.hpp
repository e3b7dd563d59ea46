// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace topo::sync {

/// What two threads must not share when both write. A constant of ours, because
/// std::hardware_destructive_interference_size may differ between translation units with their -mtune.
inline constexpr std::size_t kCacheLine = 64;

}  // namespace topo::sync
