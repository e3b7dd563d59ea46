// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "daemon/config/load.hpp"

namespace topo::daemon {

/// The configuration of a replay of a recording: it continues no session of the robot, keeps none in the
/// robot's folder (and removes none there), saves no map automatically, and has no team. `sessions`: a folder
/// for the replay's own sessions; empty: it keeps none.
[[nodiscard]] LoadedConfiguration replayed(LoadedConfiguration loaded, const std::string& sessions);

}  // namespace topo::daemon
