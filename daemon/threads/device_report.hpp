// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "daemon/threads/hand_overs.hpp"
#include "drivers/hokuyo/session.hpp"
#include "drivers/pioneer/session.hpp"

namespace topo::daemon {

/// What the sessions say of their device, in storage of fixed size. Allocate nothing.
void fill_report(DeviceReport& report, const hokuyo::Session& session);
void fill_report(DeviceReport& report, const pioneer::Session& session);

}  // namespace topo::daemon
