// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <optional>

#include "core/types/base_state.hpp"
#include "core/types/scan.hpp"
#include "tests/sim/simulation.hpp"
#include "tests/sim/way_point_drive.hpp"

namespace topo::sim {

/// The values that the drivers would decode from a robot's bytes, without the bytes: for lock-step runs
/// faster than real time. The resolution is that of the wire: ranges in whole millimetres, dead reckoning
/// from the encoders in whole millimetres and 4096 headings, ten times a second. Laser 0 is the front one,
/// laser 1 the coronal one.
class ValueFeed final : public SensorSink {
 public:
  ValueFeed(const RobotSetup& setup);

  void on_sweep(std::size_t laser, const Sweep& sweep) override;
  void on_sonar(const SonarEcho&) override {}

  /// Call after every advance of at most 10 ms; makes an odometry sample every 100 ms.
  void sample(const RobotBody& body);

  /// The next value in order of arrival; none when all are taken.
  [[nodiscard]] std::optional<types::Odometry> next_odometry();
  [[nodiscard]] bool next_scan(std::size_t laser, types::Scan& out);

 private:
  static constexpr SimTime kSipPeriod{100'000'000};
  std::vector<LaserModel> models_;
  std::vector<std::deque<types::Scan>> scans_;
  std::deque<types::Odometry> odometry_;
  DeadReckoning reckoning_;
  SimTime next_sample_{0};
};

}  // namespace topo::sim
