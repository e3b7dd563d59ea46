// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/types/result.hpp"
#include "tests/bench/carmen/carmen_log.hpp"
#include "tests/bench/carmen/fields.hpp"

namespace topo::bench {

/// One message, each function for those of its layout; errors give the line. What a layout does not hold
/// stays at its default: FLASER has neither angles nor reach, RAWLASER no poses.
types::Result<CarmenScan> read_flaser(const Fields& f);      ///< FLASER, RLASER
types::Result<CarmenScan> read_robotlaser(const Fields& f);  ///< ROBOTLASER0..9
types::Result<CarmenScan> read_rawlaser(const Fields& f);    ///< RAWLASER0..9
types::Result<CarmenOdometry> read_odometry(const Fields& f);

/// True when a message's field of view and resolution do not fit its number of readings; the resolution is
/// held unless the field of view alone puts the middle beam ahead.
bool states_two_fans(const Fields& f);

/// Marks readings at or beyond scan.range_max_m as without return.
void mark_beyond_reach(CarmenScan& scan);

}  // namespace topo::bench
