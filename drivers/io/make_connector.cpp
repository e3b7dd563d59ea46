// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/io/make_connector.hpp"

#include <charconv>
#include <cstdint>
#include <string>

#include "drivers/io/serial.hpp"
#include "drivers/io/tcp.hpp"

namespace topo::io {
namespace {

using types::Errc;
using types::fail;

constexpr std::string_view kSerial = "serial:";
constexpr std::string_view kTcp = "tcp:";

tl::unexpected<types::Error> fail_address(std::string_view address, std::string_view what) {
  std::string message("device address \"");
  message.append(address).append("\": ").append(what);
  message +=
      "; expected serial:/dev/NAME, /dev/NAME or tcp:HOST:PORT (tcp:192.168.0.10:10940, tcp:[::1]:10940)";
  return fail(Errc::kInvalidInput, std::move(message));
}

Result<std::unique_ptr<Connector>> make_serial(std::string_view address, std::string_view path) {
  if (!path.starts_with('/')) return fail_address(address, "the device is no absolute path");
  return std::make_unique<SerialConnector>(std::string(path), std::string(address));
}

Result<std::unique_ptr<Connector>> make_tcp(std::string_view address, std::string_view rest) {
  const std::size_t colon = rest.rfind(':');
  if (colon == std::string_view::npos) return fail_address(address, "the port is missing");
  std::string_view host = rest.substr(0, colon);
  const std::string_view port_text = rest.substr(colon + 1);
  if (host.size() > 2 && host.front() == '[' && host.back() == ']') {
    host = host.substr(1, host.size() - 2);
  } else if (host.find(':') != std::string_view::npos) {
    return fail_address(address, "an IPv6 address needs brackets");
  }
  if (host.empty()) return fail_address(address, "the host is missing");
  std::uint16_t port = 0;
  const char* const end = port_text.data() + port_text.size();
  const auto [stop, error] = std::from_chars(port_text.data(), end, port);
  if (error != std::errc{} || stop != end || port == 0)
    return fail_address(address, "the port is no number from 1 to 65535");
  return std::make_unique<TcpConnector>(std::string(host), port, std::string(address));
}

}  // namespace

Result<std::unique_ptr<Connector>> make_connector(std::string_view address) {
  if (address.starts_with(kSerial)) return make_serial(address, address.substr(kSerial.size()));
  if (address.starts_with(kTcp)) return make_tcp(address, address.substr(kTcp.size()));
  if (address.starts_with("/")) return make_serial(address, address);
  if (address.starts_with("can:"))
    return fail_address(address, "a CAN bus carries the base and nothing else");
  return fail_address(address, "unknown kind");
}

}  // namespace topo::io
