// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "daemon/threads/hand_overs.hpp"
#include "drivers/hokuyo/connection.hpp"
#include "drivers/pioneer/connection.hpp"

namespace topo::daemon {

/// Fill in a connection's report on its device, in storage of fixed size. Allocate nothing.
void fill_report(DeviceReport& report, const hokuyo::Connection& connection);
void fill_report(DeviceReport& report, const pioneer::Connection& connection);

}  // namespace topo::daemon
