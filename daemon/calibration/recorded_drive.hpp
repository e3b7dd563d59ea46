// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "core/calibration/calibrate.hpp"
#include "core/types/result.hpp"
#include "daemon/config/configuration.hpp"

namespace topo::daemon {

/// Plays a recording through the drivers, at once, and keeps the drive that is in it. Odometry is that of the
/// model's wheels, whatever the configuration has of an earlier calibration, and without gyro. Errors: as
/// Replay::open(); kProtocol, with the connection's words, when a device's bytes have no values in them.
types::Result<calibration::DriveLog> recorded_drive(const std::string& file,
                                                    const Configuration& configuration, double scan_period_s);

/// What the configuration says of what a drive calibrates. `model_track_m`: in place of a track of 0.
[[nodiscard]] calibration::Assumed assumed(const Configuration& configuration, double model_track_m);

}  // namespace topo::daemon
