// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "daemon/app/doctor.hpp"
#include "daemon/control/json_rpc.hpp"
#include "daemon/threads/hand_overs.hpp"
#include "daemon/threads/vitals.hpp"

namespace topo::daemon {

class Workers;

/// The state of the base in words, for operators.
std::string state_text(const BaseReport& base);

/// Main's view of the other threads: the newest of every report, and whether the threads advance. Main only.
class Monitor {
 public:
  Monitor(const Configuration& configuration, HandOvers& hand_overs, const Workers& workers);

  /// Takes new reports; to be called periodically. Logs every change of a device's state once.
  void update(types::Stamp now);

  /// True when every vital thread advanced recently: the condition for feeding the service manager's
  /// watchdog.
  [[nodiscard]] bool alive() const { return stuck_.empty(); }
  [[nodiscard]] const BaseReport& base() const { return base_; }
  [[nodiscard]] const MappingReport& mapping() const { return mapping_; }
  [[nodiscard]] bool has_map() const { return mapping_.keyframes > 0; }
  /// The first device that does not work, and the reason; empty when all work and the base accepts commands.
  [[nodiscard]] std::string device_obstacle() const;
  /// Why the base takes no commands, by hand either; empty: it takes them.
  [[nodiscard]] std::string base_obstacle() const;
  /// One line for the service manager.
  [[nodiscard]] std::string summary() const;

  /// Records, for the doctor, a request that the system refused; logs it.
  void note_refusal(const std::string& refusal);
  /// The doctor's input, as far as it is known here.
  [[nodiscard]] DoctorFacts facts() const;

  [[nodiscard]] Json status() const;
  [[nodiscard]] Json health() const;
  [[nodiscard]] Json latency() const;

  /// T_map_base at a time near the newest odometry's, by its speed.
  [[nodiscard]] types::Se2 pose_at(types::Stamp at) const;

 private:
  [[nodiscard]] types::Se2 pose() const;
  struct Device {
    std::string_view name;
    sync::Latest<DeviceReport>* source;
    DeviceReport report;
  };
  /// Counters of the mapper and of the bus at one time.
  struct Tally {
    types::Stamp stamp{};
    std::uint64_t matched = 0, lost = 0;
    io::BusFaults bus;
  };
  struct Pulse {
    const Vitals* vitals = nullptr;
    types::Duration patience{};
    std::uint64_t beats = 0;
    types::Stamp changed{};
  };
  [[nodiscard]] static std::string obstacle_of(const Device& device);
  void update_devices();
  void tell_doubts(const plausibility::DoubtSet& before, const plausibility::DoubtSet& now) const;
  void update_pulses(types::Stamp now);
  void update_tallies(types::Stamp now);
  [[nodiscard]] Json devices() const;
  [[nodiscard]] Json map() const;

  const Configuration& configuration_;
  HandOvers& hand_overs_;
  const Workers& workers_;
  std::vector<Device> devices_;
  std::vector<Pulse> pulses_;
  std::vector<std::string_view> stuck_;
  std::deque<Tally> tallies_;  ///< of the last seconds
  std::vector<std::string> refusals_;
  BaseReport base_;
  MappingReport mapping_;
};

}  // namespace topo::daemon
