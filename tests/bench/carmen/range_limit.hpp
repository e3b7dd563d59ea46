// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "tests/bench/carmen/carmen_log.hpp"

namespace topo::bench {

/// The range, in metres, from which on a log's readings mean that there was no return, for logs that do not
/// state it: FLASER lines have no field for it, and a laser in its 8 m or 32 m mode, or a program that
/// truncated at 50 m, writes its limit. Such readings accumulate at the far end in all directions; one in ten
/// thousand may lie beyond. Nothing when there is no such accumulation.
std::optional<float> piled_up_range_m(std::span<const CarmenScan> scans);

/// Replaces readings at or beyond that range by types::kNoReturn; returns their number.
std::size_t mark_no_return(std::span<CarmenScan> scans, float limit_m);

}  // namespace topo::bench
