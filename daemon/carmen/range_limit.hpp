// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "daemon/carmen/carmen_log.hpp"

namespace topo::daemon {

/// The range, in metres, from which on a log's readings say that nothing came back, where the log does not
/// say so itself: FLASER lines have no field for it, and a laser in its 8 m or 32 m mode, or a program that
/// cut at 50 m, writes its limit. Such readings pile up at the far end, whichever way the beam points; one in
/// ten thousand may lie beyond. Nothing when there is no pile.
std::optional<float> piled_up_range_m(std::span<const CarmenScan> scans);

/// Makes what is at that range or beyond a beam that did not come back; says how many readings those were.
std::size_t mark_no_return(std::span<CarmenScan> scans, float limit_m);

}  // namespace topo::daemon
