// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "core/calibration/mounting.hpp"
#include "daemon/setup/dialogue.hpp"

namespace topo::daemon {

/// What was found, one device a line.
[[nodiscard]] std::string found_text(const Found& found);

/// Why the pictures do not tell how the scanners are mounted, and what to do.
[[nodiscard]] std::string doubt_text(calibration::MountDoubt doubt);

/// How the scanners are mounted.
[[nodiscard]] std::string mounts_text(const Configuration& values);

/// "KEY = VALUE" of all that was found and said, as it will stand in the file.
[[nodiscard]] std::string changes_text(const SetupState& state);

}  // namespace topo::daemon
