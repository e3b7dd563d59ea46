// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/types/result.hpp"
#include "daemon/estop/stop_robot.hpp"
#include "drivers/io/byte_stream.hpp"

namespace topo::daemon {

/// In place of stop_robot() for a robot that did not obey: writes nothing, because every byte feeds its
/// watchdog, and listens whether it stands. Blocks at most `limit`; an Error when the port cannot be opened
/// or read. One thread; allocates.
types::Result<StopOutcome> watch_robot(io::Connector& connector, types::Duration limit = kStopLimit);

}  // namespace topo::daemon
