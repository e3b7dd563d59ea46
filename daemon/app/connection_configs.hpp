// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "daemon/config/configuration.hpp"
#include "drivers/hokuyo/connection.hpp"
#include "drivers/pioneer/connection.hpp"

namespace topo::daemon {

// What a configuration means for the connection to each device.

[[nodiscard]] hokuyo::ConnectionConfig front_connection_config(const ScannerConfig& front);
[[nodiscard]] hokuyo::ConnectionConfig coronal_connection_config(const ScannerConfig& coronal);
[[nodiscard]] pioneer::ConnectionConfig base_connection_config(const Configuration& configuration);

}  // namespace topo::daemon
