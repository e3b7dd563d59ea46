// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "daemon/app/app.hpp"
#include "daemon/topoctl/client.hpp"
#include "tests/sim/devices/sim_harness.hpp"
#include "tests/unit/daemon/support/temp_dir.hpp"

namespace topo::test {

using daemon::Json;

/// On which kind of wires the robot's devices answer.
enum class Wires { kTcp, kPty };

/// What the simulator knows, all of one moment.
struct Moment {
  sim::Truth truth;
  double v_mps = 0.0;      ///< of the wheels
  double omega_radps = 0;  ///< the body's
  bool stands = false;     ///< no wheel turns
  std::uint64_t e_stops = 0;
  std::array<std::uint32_t, 2> laser_ms{};  ///< the counters of the two scanners
};

/// How late this machine wakes a thread that sleeps: without real-time rights a test's bounds have to allow
/// for it, and measured apart from the daemon it cannot hide a fault of the daemon.
class MachineWatch {
 public:
  MachineWatch();
  ~MachineWatch();
  MachineWatch(const MachineWatch&) = delete;
  MachineWatch& operator=(const MachineWatch&) = delete;
  void restart() { latest_ns_ = 0; }
  [[nodiscard]] double late_s() const { return 1e-9 * static_cast<double>(latest_ns_.load()); }

 private:
  std::atomic<std::int64_t> latest_ns_{0};
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

struct WireSetup {
  Wires wires = Wires::kTcp;
  int watchdog_ms = 2000;
  bool sonar = true;
  std::uint64_t seed = 1;
  bool journal = false;  ///< sessions are kept, a journal every 0.2 s
  friend bool operator==(const WireSetup&, const WireSetup&) = default;
};

/// One robot in a hall of 30 x 8 m: toposim's devices on real sockets and terminals, and against them all of
/// the daemon, driven over its control socket. Both in this process, so that a test reads the truth of the
/// very moment in which it strikes. Wires, sessions, threads and clocks are the real ones.
class WireRig {
 public:
  static constexpr double kV_mps = 0.7;              ///< base.v_max_mps of the configuration
  static constexpr double kDeceleration_mps2 = 0.5;  ///< base.deceleration_mps2
  static constexpr double kWatchdog_s = 2.0;         ///< of the firmware

  /// Null (and a failure of the test) when something does not come up.
  static std::unique_ptr<WireRig> start(const WireSetup& setup);
  ~WireRig();
  WireRig(const WireRig&) = delete;
  WireRig& operator=(const WireRig&) = delete;

  /// toposim's control commands, one JSON object each, all in one round of the simulation: the moment in
  /// which they struck.
  Moment strike(const std::vector<Json>& commands) { return strike_and_hear(commands).first; }
  /// The same, and toposim's answers.
  std::pair<Moment, std::vector<Json>> strike_and_hear(const std::vector<Json>& commands);
  Moment moment();
  sim::SimHarness& simulator() { return *simulator_; }
  [[nodiscard]] const MachineWatch& machine() const { return machine_; }

  /// A method of the control protocol that has to succeed; and one that may be refused.
  Json ask(const char* method, const Json& params = Json::object());
  bool try_ask(const char* method, const Json& params = Json::object());
  /// The daemon's end, in order, and its next start.
  void restart_daemon();
  /// The same for one that is killed, as far as its session goes: the journal stays as it was; what happens
  /// meanwhile. Needs WireSetup::journal.
  void kill_daemon(const std::function<void()>& meanwhile);
  Json status() { return ask("status"); }
  bool is_ready();

  /// Until it is so (asked every 20 ms) or for so long. False: time was up.
  static bool wait(double seconds, const std::function<bool()>& is_so);

  /// A mission down the hall, begun anew where there are less than some metres left: true at full speed
  /// straight ahead.
  bool reach_full_speed(double patience_s = 90.0);
  /// From the robot to the wall at the end of the hall that it looks at.
  static double room_ahead_m(const Moment& moment);

 private:
  WireRig() = default;
  bool start_simulator(const WireSetup& setup);
  bool start_daemon();
  void end_daemon();
  std::string sessions() { return folder_.file("sessions"); }
  std::string configuration();
  void order_down_the_hall(bool to_the_east);

  WireSetup setup_;
  daemon::testing::TempDir folder_;
  std::unique_ptr<sim::SimHarness> simulator_;
  std::unique_ptr<daemon::App> app_;
  std::thread thread_;
  types::Status ran_;
  std::optional<daemon::Client> client_;
  bool to_the_east_ = false;  ///< the last order
  MachineWatch machine_;
};

}  // namespace topo::test
