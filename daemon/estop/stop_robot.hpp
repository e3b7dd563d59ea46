// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/types/result.hpp"
#include "drivers/io/byte_stream.hpp"

namespace topo::daemon {

/// What is known of the robot once the bytes are out.
enum class StopOutcome {
  kStands,  ///< it reported wheels at rest afterwards
  kSilent,  ///< it reported nothing: no session was open, it is switched off, or the line goes one way only
  kMoves,   ///< its last report still had turning wheels
};

/// How long stop_robot() may take, with the time it waits for a port that is not let go yet.
inline constexpr types::Duration kStopLimit = std::chrono::milliseconds(950);

/// Stops a robot whose daemon is gone: E_STOP, VEL 0, RVEL 0, then, when it stands or the time is up, CLOSE,
/// because a robot without motors does not brake (DESIGN "Motion and safety"; PROTOCOLS section 2). On a line
/// with a speed first at the speed it was left with, then at all others, unless the robot is heard before.
/// A port that another program still holds, or that closes, is tried again until the limit. May be repeated.
/// Blocks at most `limit`; an Error when the bytes did not get out. One thread; allocates.
types::Result<StopOutcome> stop_robot(io::Connector& connector, types::Duration limit = kStopLimit);

}  // namespace topo::daemon
