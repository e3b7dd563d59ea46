// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string_view>

#include "drivers/io/byte_stream.hpp"

namespace topo::io {

/// The connector for an address of the configuration: "serial:/dev/ttyUSB0", "/dev/ttyUSB0",
/// "tcp:192.168.0.10:10940" or "tcp:[fe80::1]:10940". Opens nothing. kInvalidInput gives the value found and
/// the accepted forms.
Result<std::unique_ptr<Connector>> make_connector(std::string_view address);

}  // namespace topo::io
