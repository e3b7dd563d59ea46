// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "daemon/config/load.hpp"

namespace topo::daemon {

/// Adds a fault for every contradiction between values that are each valid.
void check_consistency(LoadedConfiguration& loaded);

/// A serial number in the form used for comparison: capital letters, and a leading 0 equals H (the sensor
/// reports one, its label shows the other; PROTOCOLS section 11).
std::string normal_serial_number(std::string_view text);

}  // namespace topo::daemon
