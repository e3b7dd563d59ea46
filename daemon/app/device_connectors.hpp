// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "daemon/app/connector_factory.hpp"
#include "daemon/recording/recorder.hpp"
#include "daemon/recording/replay.hpp"

namespace topo::daemon {

/// Connectors of real devices; all bytes also go to `recorder` unless it is null. `recorder` must outlive the
/// connectors.
ConnectorFactory device_connectors(Recorder* recorder);

/// Connectors that play a recording instead of the devices.
ConnectorFactory replay_connectors(std::shared_ptr<Replay> replay);

}  // namespace topo::daemon
