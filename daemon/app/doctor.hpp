// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "daemon/config/configuration.hpp"
#include "daemon/threads/hand_overs.hpp"
#include "drivers/io/bus_faults.hpp"
#include "drivers/io/can_interface.hpp"

namespace topo::daemon {

/// What the doctor looks at; a value, so that a test makes it up.
struct DoctorFacts {
  struct Device {
    std::string name, address, state, message;
    bool working = false;
  };
  std::vector<Device> devices;
  struct Can {
    std::string name;
    io::CanInterface interface;
    std::string unknown{};          ///< why the kernel does not tell of it; empty: it does
    io::BusFaults faults_lately{};  ///< of the last seconds
  };
  std::optional<Can> can;  ///< when the base is on a CAN bus
  BaseReport base;
  bool estop_latched = false;      ///< as the operator knows it; base may tell of before a clear
  std::optional<int> watchdog_ms;  ///< of the firmware; nothing before the robot was asked
  types::BatteryLimits battery;
  bool has_map = false;
  std::uint64_t scans_lost_lately = 0;     ///< of the last seconds: matched nothing
  std::uint64_t scans_matched_lately = 0;  ///< the same: matched
  RealtimePolicy policy = RealtimePolicy::kOff;
  std::vector<std::string> refusals;  ///< of the system: real-time scheduling, locked memory
  std::vector<std::string> stuck;     ///< threads that do not advance
  struct Disk {
    std::string folder;                         ///< where something is written by itself
    std::optional<std::uint64_t> free_bytes{};  ///< there; nothing when it is none that we may write to
  };
  std::vector<Disk> disks;
  std::string sessions;          ///< folder where the session is kept; empty: nowhere
  std::string session_obstacle;  ///< why the robot is not sent off because of one; empty: it is
  JournalReport journal;         ///< of the session that is kept
};

/// One finding.
struct Check {
  std::string name;
  bool ok = true;
  std::string found;
  std::string cure;  ///< in plain words; empty when ok
};

/// Why the robot will not move, and what else is not as it should be: every check, good ones too.
std::vector<Check> examine(const DoctorFacts& facts);

}  // namespace topo::daemon
