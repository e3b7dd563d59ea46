// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/threads/device_report.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace topo::daemon {
namespace {

std::string_view state_name(hokuyo::Health health) {
  switch (health) {
    case hokuyo::Health::kDisconnected:
      return "disconnected";
    case hokuyo::Health::kConnecting:
      return "connecting";
    case hokuyo::Health::kWrongDevice:
      return "wrong device";
    case hokuyo::Health::kStarting:
      return "starting";
    case hokuyo::Health::kStreaming:
      return "streaming";
    case hokuyo::Health::kSilent:
      return "silent";
    case hokuyo::Health::kLate:
      return "late";
    case hokuyo::Health::kDamaged:
      return "damaged";
    case hokuyo::Health::kUnusable:
      return "unusable";
    case hokuyo::Health::kFault:
      return "fault";
  }
  return "?";
}

std::string_view state_name(pioneer::Health health) {
  switch (health) {
    case pioneer::Health::kDisconnected:
      return "disconnected";
    case pioneer::Health::kConnecting:
      return "connecting";
    case pioneer::Health::kWrongDevice:
      return "wrong device";
    case pioneer::Health::kReady:
      return "ready";
    case pioneer::Health::kOnTrial:
      return "on trial";
    case pioneer::Health::kSilent:
      return "silent";
    case pioneer::Health::kRefuses:
      return "refuses";
    case pioneer::Health::kUnidentified:
      return "unidentified";
    case pioneer::Health::kUnsafe:
      return "unsafe";
    case pioneer::Health::kReset:
      return "reset";
  }
  return "?";
}

/// Writes "model, serial number, firmware" into the report's own storage.
template <class Info>
void set_identity(DeviceReport& report, std::string_view model, const Info& info) {
  std::array<char, 120> text{};
  const auto end = fmt::format_to_n(text.data(), text.size(), "{}, serial number {}, firmware {}", model,
                                    info.serial_number, info.firmware);
  report.identity = std::string_view(text.data(), std::min(end.size, text.size()));
}

}  // namespace

void fill_report(DeviceReport& report, const hokuyo::Connection& connection) {
  report.state = state_name(connection.health());
  report.message = connection.message();
  report.working = connection.health() == hokuyo::Health::kStreaming;
  if (connection.info()) set_identity(report, connection.info()->model, *connection.info());
  if (connection.info()) report.assumed = connection.info()->assumed;
  const hokuyo::Counters& c = connection.counters();
  report.counters = {c.scans, c.checksum_errors, c.resyncs, c.reconnects, c.lost_scans, c.bytes};
}

void fill_report(DeviceReport& report, const pioneer::Connection& connection) {
  report.state = state_name(connection.health());
  report.message = connection.message();
  report.working = connection.health() == pioneer::Health::kReady;
  if (connection.info()) set_identity(report, connection.info()->subclass, *connection.info());
  if (connection.info()) report.watchdog_ms = connection.info()->watchdog_ms;
  if (connection.info())
    report.watchdog_given = connection.info()->watchdog != pioneer::WatchdogSource::kTold;
  if (connection.info()) report.assumed = connection.info()->assumed;
  const pioneer::Counters& c = connection.counters();
  report.counters = {c.status_packets, c.bad_packets, c.lost_packets, c.reconnects, c.commands, c.bytes};
  report.bus = c.bus;
}

}  // namespace topo::daemon
