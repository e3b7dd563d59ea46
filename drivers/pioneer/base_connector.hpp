// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "drivers/io/byte_stream.hpp"

namespace topo::pioneer {

/// A robot on a CAN bus.
struct CanAddress {
  std::string interface;
  int unit = 0;
  friend bool operator==(const CanAddress&, const CanAddress&) = default;
};

/// "can:can0", equal to "can:can0:0", or "can:can0:3" for unit 3 of 0..7. Nothing when `address` does not
/// begin with "can:"; kInvalidInput gives the value found and the accepted forms.
types::Result<std::optional<CanAddress>> parse_can_address(std::string_view address);

/// The connector for the base: the addresses of io::make_connector(), and a robot on CAN. Opens nothing. On
/// CAN, connect() refuses an interface that is missing, not a CAN interface, switched off or bus-off, with
/// the cure in the message.
types::Result<std::unique_ptr<io::Connector>> make_base_connector(std::string_view address);

}  // namespace topo::pioneer
