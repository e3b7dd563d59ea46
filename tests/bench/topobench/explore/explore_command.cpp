// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/explore/explore_command.hpp"

#include <fmt/format.h>

#include "tests/bench/topobench/explore/explore_report.hpp"
#include "tests/bench/topobench/explore/explore_run.hpp"
#include "tests/bench/topobench/output.hpp"

namespace topo::bench {
namespace {

using types::Errc;

/// Says now and then on standard error how it goes.
class Progress final : public RunHooks {
 public:
  void planned(const pipeline::PlanningOutput& output) override {
    const pipeline::PlanningReport& report = *output.report;
    if (report.stamp < next_) return;
    next_ = report.stamp + std::chrono::seconds(60);
    fmt::print(stderr, "{:6.0f} s  {:9s} {:6.1f} m2 known, {} goals open, {} frontiers: {}\n",
               types::to_seconds(report.stamp), to_text(report.activity), report.known_m2,
               report.open_goals.size(), report.frontier_clusters, report.reason);
  }

 private:
  types::Stamp next_{};
};

types::Status check(const ExploreCommand& command) {
  if (command.robots != 1) {
    return types::fail(
        Errc::kInvalidInput,
        fmt::format("--robots: found {}, expected 1: robots do not work as a team yet", command.robots));
  }
  if (!command.start.empty() && command.start.size() != 3)
    return types::fail(Errc::kInvalidInput, "--start: expected X,Y,THETA in metres and radians");
  if (!(command.limit_s > 0.0))
    return types::fail(Errc::kInvalidInput,
                       fmt::format("--limit: found {}, expected seconds above 0", command.limit_s));
  return {};
}

RunSetup setup_of(const ExploreCommand& command, const sim::World& world) {
  const auto& s = command.start;
  const sim::Se2 start = s.empty() ? world.start_poses().front() : sim::Se2{s[0], s[1], s[2]};
  RunSetup setup =
      default_setup(start, command.seed, command.fidelity == "full" ? Fidelity::kFull : Fidelity::kPlan);
  setup.limit_s = command.limit_s;
  setup.mind.planner.strategy = command.strategy == "topometric" ? pipeline::Strategy::kTopometric
                                                                 : pipeline::Strategy::kNearestFrontier;
  setup.mind.planner.finish =
      command.finish == "complete" ? pipeline::Finish::kComplete : pipeline::Finish::kEssential;
  return setup;
}

}  // namespace

types::Status run_explore(const ExploreCommand& command) {
  if (auto status = check(command); !status) return status;
  auto world = sim::World::load(command.world);
  if (!world) return tl::unexpected(world.error());
  const RunSetup setup = setup_of(command, *world);
  const RunTitle title{command.world.stem().string(), command.strategy, command.finish, command.seed};
  const sim::Raster visible =
      reachable_area(*world, setup.plant.start.translation(), sim::RobotModel::p3dx().swing_radius_m).visible;
  auto plant = make_plant(std::move(*world), setup);
  if (!plant) return tl::unexpected(plant.error());
  const auto mind = make_mind(setup);
  Progress progress;
  const RunResult result = run_exploration(**plant, *mind, setup, visible, &progress);
  if (!command.out.empty()) {
    if (auto written = write_run_files(command.out, (*plant)->world(), setup, result, visible); !written)
      return written;
    if (auto written = write_map(command.out, mind->source().map()); !written) return written;
  }
  const nlohmann::json json = report_of(title, setup, result, visible.area_m2());
  fmt::print("{}\n", command.json ? json.dump() : json.dump(2));
  return {};
}

}  // namespace topo::bench
