// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "core/types/result.hpp"
#include "tests/sim/devices/sim_rig.hpp"

namespace topo::sim {

/// A simulation with its devices in a thread of the test's process. All calls are thread-safe and blocking:
/// each waits for the end of the simulation's cycle, about a millisecond.
class SimHarness {
 public:
  /// Starts the simulation; the devices answer when this returns.
  static types::Result<std::unique_ptr<SimHarness>> start(World world, const RigConfig& config);
  ~SimHarness();
  SimHarness(const SimHarness&) = delete;
  SimHarness& operator=(const SimHarness&) = delete;

  /// Address of a robot's device: TCP host and port, or the path of the terminal. Constant.
  [[nodiscard]] const DeviceAddress& address(std::size_t robot, DeviceId device) const {
    return addresses_[robot][static_cast<std::size_t>(device)];
  }
  [[nodiscard]] Truth truth(std::size_t robot = 0) {
    return with_rig([robot](SimRig& rig) { return rig.truth(robot); });
  }
  /// Runs a line of the control protocol (commands.hpp), e.g. {"command":"cut","device":"front","seconds":2}.
  std::string command(const std::string& line);

  // The faults by name; commands.hpp explains them.
  void silence(std::size_t robot, DeviceId device, double seconds);
  void cut(std::size_t robot, DeviceId device, double seconds);
  void garbage(std::size_t robot, DeviceId device, std::size_t bytes);
  void slow(std::size_t robot, DeviceId device, double bytes_per_s);
  void drop(std::size_t robot, DeviceId device, double rate);
  void dead(std::size_t robot, DeviceId laser, ScipHealth health);
  void reset(std::size_t robot, DeviceId device);
  void stop_button(std::size_t robot, bool pressed);
  void bumper(std::size_t robot, std::uint8_t front, std::uint8_t rear, double seconds);
  void battery(std::size_t robot, double volts);
  void clock_jump(std::size_t robot, DeviceId laser, double ms);
  types::Result<MovableId> obstacle(std::size_t robot, double distance_m);

  /// Runs a function in the simulation's thread, between two cycles, and returns its result.
  template <class F>
  auto with_rig(F&& f) -> std::invoke_result_t<F, SimRig&> {
    std::packaged_task<std::invoke_result_t<F, SimRig&>(SimRig&)> task(std::forward<F>(f));
    auto result = task.get_future();
    post([&task](SimRig& rig) { task(rig); });
    return result.get();
  }

 private:
  explicit SimHarness(std::unique_ptr<SimRig> rig);
  void run();
  void post(std::function<void(SimRig&)> job);
  bool take_jobs(std::vector<std::function<void(SimRig&)>>& jobs);

  std::unique_ptr<SimRig> rig_;  ///< used only by the thread after the start
  std::vector<std::array<DeviceAddress, kDeviceCount>> addresses_;
  std::mutex mutex_;
  std::vector<std::function<void(SimRig&)>> jobs_;
  bool stop_ = false;
  std::thread thread_;
};

}  // namespace topo::sim
