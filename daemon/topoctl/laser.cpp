// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// The scanners' own settings. These commands talk to the scanner, not to the daemon.
#include <fmt/format.h>

#include <cstdio>

#include "daemon/topoctl/commands.hpp"
#include "drivers/hokuyo/set_ip.hpp"
#include "drivers/io/make_connector.hpp"

namespace topo::daemon {
namespace {

constexpr std::uint8_t kGatewayHost = 1;  // of a factory's network, 192.168.0.1 (PROTOCOLS section 11.1)
constexpr const char* kScipPort = "10940";

types::Result<hokuyo::IpSettings> settings_of(const Arguments& a) {
  hokuyo::IpSettings settings;
  const auto read = [](const std::string& text, std::array<std::uint8_t, 4>& into) -> types::Status {
    const auto parsed = hokuyo::parse_ipv4(text);
    if (!parsed) return tl::unexpected(parsed.error());
    into = *parsed;
    return {};
  };
  if (auto s = read(a.laser.new_address, settings.address); !s) return tl::unexpected(s.error());
  if (auto s = read(a.laser.netmask, settings.netmask); !s) return tl::unexpected(s.error());
  settings.gateway = settings.address;
  settings.gateway[3] = kGatewayHost;
  if (!a.laser.gateway.empty())
    if (auto s = read(a.laser.gateway, settings.gateway); !s) return tl::unexpected(s.error());
  if (auto s = hokuyo::check(settings); !s) return tl::unexpected(s.error());
  return settings;
}

/// "192.168.0.10" and "tcp:192.168.0.10:10940" are the same scanner.
std::string device_address(const std::string& text) {
  return text.find(':') == std::string::npos && !text.starts_with('/')
             ? fmt::format("tcp:{}:{}", text, kScipPort)
             : text;
}

/// As complain(), but it is the scanner that is not there, not the daemon.
int refuse(const types::Error& error) {
  const int status = complain(error);
  return status == kNoDaemon ? kFailed : status;
}

}  // namespace

int set_laser_ip(const Arguments& a) {
  const auto settings = settings_of(a);
  if (!settings) return refuse(settings.error());
  auto connector = io::make_connector(device_address(a.laser.address));
  if (!connector) return refuse(connector.error());
  const auto taken = hokuyo::set_ip(**connector, *settings, a.laser.serial_number);
  if (!taken) return refuse(taken.error());
  const std::string address = fmt::format("tcp:{}:{}", hokuyo::to_text(settings->address), kScipPort);
  fmt::print("{} {} has taken the address {}.\nSwitch its power off and on now.\n", taken->product,
             taken->serial_number, hokuyo::to_text(settings->address));
  if (a.laser.patience_s <= 0.0) return kOk;
  std::fflush(stdout);
  auto there = io::make_connector(address);
  if (!there) return refuse(there.error());
  if (const auto found =
          hokuyo::await_sensor(**there, taken->serial_number, types::from_seconds(a.laser.patience_s));
      !found)
    return refuse(found.error());
  fmt::print("It answers at its new address: write \"{}\" into the configuration.\n", address);
  return kOk;
}

}  // namespace topo::daemon
