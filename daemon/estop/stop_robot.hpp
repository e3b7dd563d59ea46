// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/types/result.hpp"
#include "drivers/io/byte_stream.hpp"

namespace topo::daemon {

/// State of the robot after the bytes were written.
enum class StopOutcome {
  kStands,  ///< it reported standing wheels afterwards
  kSilent,  ///< it reported nothing: no connection was open, it is off, or the line works one way only
  kMoves,   ///< its last report still showed turning wheels
};

/// Limit of stop_robot(), including the wait for a port that is still in use.
inline constexpr types::Duration kStopLimit = std::chrono::milliseconds(950);

/// Stops a robot whose daemon has ended: E_STOP, VEL 0, RVEL 0, then CLOSE when it stands or the time is up,
/// because a robot without motors does not brake (DESIGN "Motion and safety"; PROTOCOLS section 2). On a line
/// with a speed, tries the present speed first, then all others, until the robot answers. A port that another
/// program still holds, or that closes, is retried until the limit. May be repeated. Blocks at most `limit`;
/// an Error when the bytes could not be written. One thread; allocates.
types::Result<StopOutcome> stop_robot(io::Connector& connector, types::Duration limit = kStopLimit);

}  // namespace topo::daemon
