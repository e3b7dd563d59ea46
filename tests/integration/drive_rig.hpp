// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/pipeline/control_step.hpp"
#include "tests/bench/topobench/explore/virtual_base.hpp"
#include "tests/sim/simulation.hpp"
#include "tests/sim/value_feed.hpp"

namespace topo::test {

struct DriveSetup {
  std::string model = "p3dx";
  sim::Se2 start;
  sim::Difficulty difficulty;
  std::uint64_t seed = 1;
  types::Duration watchdog = std::chrono::milliseconds(2000);
  std::optional<double> v_max_mps{};  ///< nullopt: the usual one of the model
};

/// Limits and places of the sensors as the daemon has them for a model.
pipeline::ControlSetup control_setup(const std::string& model);

/// The way between two points of a building, as the planner would lay it when it knew everything; empty when
/// there is none.
std::vector<sim::Vector2> way_in(const sim::World& world, const sim::Vector2& from, const sim::Vector2& to);

/// One robot in a building, in lock-step: the base thread's pure step every 50 ms, a plan twice a second from
/// a route that was given (its place in odom from the truth, as a mapper without errors would have it), and
/// the faults that spoil values on their way.
class DriveRig {
 public:
  DriveRig(sim::World world, const DriveSetup& setup);

  /// A new goal: along these points.
  void go(std::vector<sim::Vector2> route);
  /// Until `done` (asked after every control period) or for so long. False: time was up.
  bool run(
      double seconds, const std::function<bool()>& done = [] { return false; });

  [[nodiscard]] sim::Simulation& simulation() { return *simulation_; }
  [[nodiscard]] const sim::RobotBody& body() const { return simulation_->body(0); }
  [[nodiscard]] const pipeline::ControlReport& report() const { return out_.report; }
  [[nodiscard]] const types::BaseCommand& command() const { return out_.command; }
  [[nodiscard]] double now_s() const { return types::to_seconds(simulation_->now()); }
  [[nodiscard]] double v_mps() const {
    return (body().encoder_left_mps() + body().encoder_right_mps()) / 2.0;
  }

  // Faults and the operator, to be set between calls of run().
  bool front_silent = false, base_silent = false, planner_silent = false;
  bool lost = false;       ///< the planner speaks, and does not know where the robot is
  bool host_dead = false;  ///< the daemon's process is gone: nothing is decided and nothing sent
  std::function<void(types::Scan&)> spoil_scan;
  std::function<void(types::BaseState&)> spoil_state;
  /// Takes the place of the line to the base: what arrives there of a command, and when.
  std::function<void(const types::BaseCommand&, bench::VirtualBase&, sim::SimTime)> carry;
  /// Motion by scan matching, as the mapping thread would report it; empty: none is reported.
  std::function<plausibility::MatchedMotion()> match;
  bool estop = false, estop_cleared = false;
  std::optional<types::Twist2> by_hand;
  pipeline::ControlSetup setup;
  types::Duration told_watchdog;

 private:
  class Sink final : public sim::SensorSink {
   public:
    explicit Sink(DriveRig& rig) : rig_(rig) {}
    void on_sweep(std::size_t laser, const sim::Sweep& sweep) override;
    void on_sonar(const sim::SonarEcho& echo) override;

   private:
    DriveRig& rig_;
  };
  void tick();
  void sense();
  void plan();
  void control();

  bench::VirtualBase base_;
  sim::ValueFeed feed_;
  Sink sink_;
  std::unique_ptr<sim::Simulation> simulation_;
  std::vector<types::Se2> T_base_sonar_;
  std::deque<types::BaseState> on_the_way_;
  types::BaseState state_;
  std::unique_ptr<types::Scan> scan_, incoming_;
  bool has_state_ = false, has_scan_ = false;
  std::vector<sim::Vector2> route_;
  std::size_t route_at_ = 0;
  pipeline::Plan plan_;
  sim::Se2 T_building_odom_;
  pipeline::Teleop teleop_;
  pipeline::ControlState state_of_control_;
  pipeline::ControlOutput out_;
  plausibility::MatchedMotion matched_;
};

}  // namespace topo::test
