// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "core/types/result.hpp"
#include "drivers/io/byte_stream.hpp"

namespace topo::daemon {

/// Makes the connector of a device from its channel ("base", "front", "coronal") and its configured address:
/// real, tapped, a recording's or a test's.
using ConnectorFactory = std::function<types::Result<std::unique_ptr<io::Connector>>(
    const std::string& channel, const std::string& address)>;

}  // namespace topo::daemon
