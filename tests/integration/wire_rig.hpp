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

#include "core/types/se2.hpp"
#include "daemon/app/app.hpp"
#include "daemon/topoctl/client.hpp"
#include "tests/integration/child_process.hpp"
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
  std::uint64_t base_bytes = 0;             ///< that the base heard since the start
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
  bool journal = false;   ///< sessions are kept, a journal every 0.2 s
  bool process = false;   ///< the daemon is a process of its own, which keeps its latches
  bool realtime = false;  ///< the daemon has real-time rights
  bool slow = false;      ///< for an emulated machine: scans at 10 Hz, the coronal scanner a URG
  std::string cgroup;     ///< of the daemon's process (ChildProcess)
  friend bool operator==(const WireSetup&, const WireSetup&) = default;
};

/// One robot in a hall of 30 x 8 m: toposim's devices on real sockets and terminals, and against them all of
/// the daemon, driven over its control socket. The devices are in this process, so that a test reads the
/// truth of the very moment in which it strikes, and so is the daemon, unless it is to be killed. Wires,
/// sessions, threads and clocks are the real ones.
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
  /// The same for one that ends by SIGKILL, and what happens meanwhile. `kill`: makes it end so. Needs
  /// WireSetup::process.
  void kill_daemon(const std::function<void()>& meanwhile,
                   const std::function<void(pid_t)>& kill = kill_at_once);
  static void kill_at_once(pid_t process);
  [[nodiscard]] pid_t daemon_pid() const { return process_->pid(); }
  /// topometric-estop with the daemon's configuration: its exit status.
  int run_estop();
  /// A file in the folder of what a daemon leaves to the next one. Needs WireSetup::process.
  [[nodiscard]] std::string state_file(std::string_view name) const;
  [[nodiscard]] std::string sessions() const { return folder_.file("sessions"); }
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
  bool start_threads(const std::string& configuration);
  bool start_process(const std::string& configuration);
  void end_daemon();
  [[nodiscard]] std::string state_folder() const { return folder_.file("state"); }
  [[nodiscard]] std::string socket() const { return folder_.file("control.sock"); }
  std::string configuration();
  /// The next daemon's map has its origin where the robot stands now.
  void map_begins_here();
  void order_down_the_hall(bool to_the_east);

  WireSetup setup_;
  daemon::testing::TempDir folder_;
  std::unique_ptr<sim::SimHarness> simulator_;
  std::unique_ptr<ChildProcess> process_;
  std::unique_ptr<daemon::App> app_;
  std::thread thread_;
  types::Status ran_;
  std::optional<daemon::Client> client_;
  bool to_the_east_ = false;  ///< the last order
  types::Se2 world_from_map_;
  MachineWatch machine_;
};

}  // namespace topo::test
