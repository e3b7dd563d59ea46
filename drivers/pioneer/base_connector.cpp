// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/pioneer/base_connector.hpp"

#include <array>
#include <cstdint>
#include <utility>

#include "drivers/io/can_interface.hpp"
#include "drivers/io/can_socket.hpp"
#include "drivers/io/make_connector.hpp"
#include "drivers/pioneer/arcos_can_stream.hpp"

namespace topo::pioneer {
namespace {

using types::Duration;
using types::Errc;
using types::fail;
using types::Result;

constexpr std::string_view kCan = "can:";

class ArcosCanConnector final : public io::Connector {
 public:
  ArcosCanConnector(CanAddress address, std::string name)
      : address_(std::move(address)), name_(std::move(name)) {}

  /// Opening a local interface does not wait.
  Result<std::unique_ptr<io::ByteStream>> connect(Duration /*timeout*/) override {
    const auto known = io::query_can_interface(address_.interface);
    if (!known) return tl::unexpected(known.error());
    const auto complaint = io::complaint_about(*known, address_.interface);
    if (complaint && complaint->blocks)
      return fail(known->exists ? Errc::kClosed : Errc::kNotFound,
                  name_ + ": " + complaint->found + "; " + complaint->cure);
    const auto unit = static_cast<std::uint16_t>(address_.unit);
    const std::array<std::uint16_t, 2> ids{static_cast<std::uint16_t>(kCanFromRobot + unit),
                                           static_cast<std::uint16_t>(kCanHeartbeat + unit)};
    auto port = io::CanSocket::open(address_.interface, ids, name_);
    if (!port) return tl::unexpected(port.error());
    return std::make_unique<ArcosCanStream>(std::move(*port), address_.unit);
  }
  [[nodiscard]] std::string_view name() const override { return name_; }

 private:
  CanAddress address_;
  std::string name_;
};

tl::unexpected<types::Error> fail_address(std::string_view address, std::string_view what) {
  std::string message("device address \"");
  message.append(address).append("\": ").append(what);
  message += "; expected can:INTERFACE or can:INTERFACE:UNIT with a unit of 0 to 7 (can:can0, can:can0:1)";
  return fail(Errc::kInvalidInput, std::move(message));
}

}  // namespace

Result<std::optional<CanAddress>> parse_can_address(std::string_view address) {
  constexpr std::size_t kLongestName = 15;  // IFNAMSIZ less the terminating NUL
  if (!address.starts_with(kCan)) return std::optional<CanAddress>();
  const std::string_view rest = address.substr(kCan.size());
  const std::size_t colon = rest.find(':');
  CanAddress found{std::string(rest.substr(0, colon)), 0};
  if (found.interface.empty()) return fail_address(address, "the interface is missing");
  if (found.interface.size() > kLongestName || found.interface.find_first_of("/ \t") != std::string::npos)
    return fail_address(address, "no interface can have this name");
  if (colon == std::string_view::npos) return std::optional(found);
  const std::string_view unit = rest.substr(colon + 1);
  if (unit.size() != 1 || unit[0] < '0' || unit[0] >= '0' + kCanUnits)
    return fail_address(address, "the unit is no number from 0 to 7");
  found.unit = unit[0] - '0';
  return std::optional(found);
}

Result<std::unique_ptr<io::Connector>> make_base_connector(std::string_view address) {
  auto can = parse_can_address(address);
  if (!can) return tl::unexpected(can.error());
  if (!*can) {
    auto other = io::make_connector(address);
    if (!other) other.error().message += ", and for the base can:INTERFACE:UNIT (can:can0:0)";
    return other;
  }
  return std::make_unique<ArcosCanConnector>(std::move(**can), std::string(address));
}

}  // namespace topo::pioneer
