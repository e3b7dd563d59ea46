// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "daemon/config/load.hpp"

namespace topo::daemon {

/// Adds a fault for every two values that are each acceptable and cannot both be meant.
void check_consistency(LoadedConfiguration& loaded);

/// A serial number as it is compared: capital letters, and a leading 0 equals H (the sensor prints one, its
/// label the other; PROTOCOLS section 11).
std::string normal_serial_number(std::string_view text);

}  // namespace topo::daemon
