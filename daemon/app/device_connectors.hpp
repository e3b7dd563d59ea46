// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "daemon/app/workers.hpp"
#include "daemon/recording/recorder.hpp"
#include "daemon/recording/replay.hpp"

namespace topo::daemon {

/// Real devices; every byte goes through `recorder` too unless it is null. `recorder` must outlive the
/// connectors.
ConnectorFactory device_connectors(Recorder* recorder);

/// A recording in place of the devices.
ConnectorFactory replay_connectors(std::shared_ptr<Replay> replay);

}  // namespace topo::daemon
