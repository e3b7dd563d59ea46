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

/// Input of examine(); a value, so that tests can construct it.
struct DoctorFacts {
  Configuration configuration{};  ///< for what it permits although it is daring
  struct Device {
    std::string name, address, state, message;
    bool working = false;
    std::string assumed{};  ///< DeviceReport::assumed
  };
  std::vector<Device> devices;
  struct Can {
    std::string name;
    io::CanInterface interface;
    std::string unknown{};          ///< why the kernel's data are missing; empty: they are present
    io::BusFaults faults_lately{};  ///< of the last seconds
  };
  std::optional<Can> can;  ///< present when the base is on a CAN bus
  BaseReport base;
  std::string estop_trouble;       ///< what is wrong with the keeping of its latch; empty: nothing
  bool estop_latched = false;      ///< according to the operator's state; `base` may be from before a clear
  std::optional<int> watchdog_ms;  ///< of the firmware; nothing before the connection
  bool watchdog_given = false;     ///< by base.watchdog_ms
  types::BatteryLimits battery;
  bool has_map = false;
  std::string map_doubt;  ///< why the map is doubted; empty: it is not, or that is not known yet
  std::uint64_t scans_lost_lately = 0;     ///< of the last seconds: scans that matched nothing
  std::uint64_t scans_matched_lately = 0;  ///< of the last seconds: scans that matched
  RealtimePolicy policy = RealtimePolicy::kOff;
  std::vector<std::string> refusals;  ///< of the system: real-time scheduling, locked memory
  std::vector<std::string> stuck;     ///< threads that do not advance
  struct Disk {
    std::string folder;                         ///< folder for automatic saves
    std::optional<std::uint64_t> free_bytes{};  ///< free there; nothing when missing or not writable
  };
  std::vector<Disk> disks;
  std::string sessions;          ///< folder of the sessions; empty: no journal is kept
  std::string session_obstacle;  ///< why a session prevents a mission; empty: none does
  types::PlaceStanding place = types::PlaceStanding::kKnown;  ///< in the session
  JournalReport journal;                                      ///< state of the current session's journal
  struct Team {
    std::string trouble;  ///< empty: none
    std::string warning;  ///< empty: none
    std::string found;    ///< when there is no trouble
  };
  std::optional<Team> team{};
};

/// One finding.
struct Check {
  std::string name;
  bool ok = true;
  std::string found;
  std::string cure;  ///< in plain words; empty when ok
  /// Of a warning: what the finding means and what would be safer; empty: no warning. A warning is ok: what
  /// is permitted does not keep the robot from moving.
  std::string safer{};
};

/// What the configuration permits although something else would be safer: sonar, margin, stamps, serial
/// numbers, speed. One check each, with a warning where it is daring.
std::vector<Check> examine_choices(const Configuration& configuration);

/// Checks everything that may keep the robot from moving, and the rest of the system; returns all checks,
/// passed ones too.
std::vector<Check> examine(const DoctorFacts& facts);

}  // namespace topo::daemon
