// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/explore/explore_command.hpp"

#include <fmt/format.h>

#include <array>
#include <span>
#include <vector>

#include "tests/bench/topobench/bound/bound_command.hpp"
#include "tests/bench/topobench/explore/calibrated_setup.hpp"
#include "tests/bench/topobench/explore/contender.hpp"
#include "tests/bench/topobench/explore/crossings.hpp"
#include "tests/bench/topobench/explore/explore_report.hpp"
#include "tests/bench/topobench/explore/explore_run.hpp"
#include "tests/bench/topobench/output.hpp"

namespace topo::bench {

namespace {

constexpr double kLimitMax_s = 1e6;     // eleven days
constexpr double kSpeedMin_mps = 0.05;  // as base.v_max_mps

using types::Errc;

constexpr int kRobotsMax = 8;

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
  if (command.robots < 1 || command.robots > kRobotsMax)
    return types::fail(Errc::kInvalidInput,
                       fmt::format("--robots: found {}, expected 1 to {}", command.robots, kRobotsMax));
  if (!command.starts_known && command.fidelity != "full")
    return types::fail(
        Errc::kInvalidInput,
        fmt::format("--starts: found unknown in fidelity {}, expected fidelity full: without a "
                    "mapper all poses are known",
                    command.fidelity));
  if (!command.calibration.empty() && (command.robots > 1 || command.fidelity != "full"))
    return types::fail(
        Errc::kInvalidInput,
        fmt::format("--calibration: found {} robots in fidelity {}, expected one in fidelity full",
                    command.robots, command.fidelity));
  if (!(command.v_max_mps >= kSpeedMin_mps && command.v_max_mps <= types::kP3dx.v_max_mps))
    return types::fail(Errc::kInvalidInput,
                       fmt::format("--speed: found {}, expected {} to {} m/s, the most of a P3-DX",
                                   command.v_max_mps, kSpeedMin_mps, types::kP3dx.v_max_mps));
  if (!command.calibration.empty() && command.v_max_mps != types::DriveLimits{}.v_max_mps)
    return types::fail(Errc::kInvalidInput, "--speed: found with --calibration, which has its own");
  if (const auto radio = parse_radio(command.radio); !radio) return tl::unexpected(radio.error());
  if (!(command.entry_delay_s >= 0.0 && command.entry_delay_s <= kLimitMax_s))
    return types::fail(Errc::kInvalidInput,
                       fmt::format("--entry-delay: found {}, expected seconds from 0 to {}",
                                   command.entry_delay_s, kLimitMax_s));
  if (!command.start.empty() && command.start.size() != 3)
    return types::fail(Errc::kInvalidInput, "--start: expected X,Y,THETA in metres and radians");
  return check_limit(command.limit_s);
}

types::Result<RunSetup> setup_of(const ExploreCommand& command, const sim::World& world) {
  const auto& s = command.start;
  const sim::Se2 start = s.empty() ? world.start_poses().front() : sim::Se2{s[0], s[1], s[2]};
  const Fidelity fidelity = command.fidelity == "full" ? Fidelity::kFull : Fidelity::kPlan;
  auto made = command.calibration.empty()
                  ? types::Result<RunSetup>(default_setup(start, command.seed, fidelity, command.v_max_mps))
                  : calibrated_setup(command.calibration, start, command.seed);
  if (!made) return made;
  RunSetup setup = std::move(*made);
  setup.limit_s = command.limit_s;
  if (auto set = set_contender(command.strategy, setup.mind.planner); !set)
    return tl::unexpected(set.error());
  setup.mind.planner.contact_lost_s = command.contact_lost_s;
  const auto finish = exploration::parse_finish(command.finish);
  if (!finish) return tl::unexpected(finish.error());
  exploration::set_finish(*finish, setup.mind.planner.explore);
  return setup;
}

/// How often the robots of a run came through the same corridors.
nlohmann::json crossings_report(const sim::World& world, std::span<const RunResult> robots) {
  std::vector<std::vector<sim::Se2>> ways;
  for (const RunResult& robot : robots) ways.push_back(robot.truth);
  const Crossings crossings = count_crossings(world.structure(), ways);
  return {{"squares", crossings.squares}, {"over_twice", crossings.over_twice}};
}

/// bound_m and way_over_bound, for 99 %; null where it was not reached.
types::Status add_bound(const ExploreCommand& command, const sim::Se2& start, nlohmann::json& report) {
  const auto bound =
      bound_report({command.world, command.robots, {start.x_m, start.y_m, start.theta_rad}, {}, true});
  if (!bound) return tl::unexpected(bound.error());
  const nlohmann::json &bound_m = (*bound)["m_per_robot"]["0.99"], &way_m = report["way_m"]["0.99"];
  report["bound_m"] = bound_m;
  report["way_over_bound"] = nullptr;
  if (bound_m.is_number() && way_m.is_number() && bound_m.get<double>() > 0.0)
    report["way_over_bound"] = way_m.get<double>() / bound_m.get<double>();
  return {};
}

types::Result<nlohmann::json> run_alone(const ExploreCommand& command, sim::World world,
                                        const RunTitle& title, const RunSetup& setup,
                                        const sim::Raster& visible, RunHooks& hooks) {
  auto plant = make_plant(std::move(world), setup);
  if (!plant) return tl::unexpected(plant.error());
  const auto mind = make_mind(setup);
  const RunResult result = run_exploration(**plant, *mind, setup, visible, &hooks);
  if (!command.out.empty()) {
    if (auto written = write_run_files(command.out, (*plant)->world(), setup, result, visible); !written)
      return tl::unexpected(written.error());
    if (auto written = write_map(command.out, mind->source().map()); !written)
      return tl::unexpected(written.error());
  }
  nlohmann::json report = report_of(title, setup, result, visible.area_m2());
  report["corridors_crossed"] = crossings_report((*plant)->world(), {&result, 1});
  return report;
}

types::Result<nlohmann::json> run_together(const ExploreCommand& command, sim::World world, RunTitle title,
                                           RunSetup setup, const sim::Raster& visible, RunHooks& hooks) {
  const auto radio = parse_radio(command.radio);
  if (!radio) return tl::unexpected(radio.error());
  title.radio = command.radio;
  const auto shared = std::make_shared<sim::World>(std::move(world));
  const TeamSetup team{std::move(setup), command.robots, *radio, command.entry_delay_s, command.starts_known};
  const std::array<RunHooks*, 1> first{&hooks};  // it speaks for all
  const auto result = run_team(shared, team, visible, first);
  if (!result) return tl::unexpected(result.error());
  if (!command.out.empty()) {
    if (auto written = write_team_files(command.out, *shared, team, *result, visible); !written)
      return tl::unexpected(written.error());
  }
  nlohmann::json report = team_report_of(title, team, *result, visible.area_m2());
  report["corridors_crossed"] = crossings_report(*shared, result->robots);
  return report;
}

}  // namespace

types::Status check_limit(double limit_s) {
  if (limit_s > 0.0 && limit_s <= kLimitMax_s) return {};
  return types::fail(
      types::Errc::kInvalidInput,
      fmt::format("--limit: found {}, expected seconds above 0, at most {}", limit_s, kLimitMax_s));
}

types::Result<nlohmann::json> explore(const ExploreCommand& command, RunHooks& hooks) {
  if (auto status = check(command); !status) return tl::unexpected(status.error());
  auto world = sim::World::load(command.world);
  if (!world) return tl::unexpected(world.error());
  const auto setup = setup_of(command, *world);
  if (!setup) return tl::unexpected(setup.error());
  if (auto made = make_folder(command.out); !made) return tl::unexpected(made.error());
  const RunTitle title{command.world.stem().string(), command.strategy, command.finish, command.seed};
  const sim::Raster visible =
      reachable_area(*world, setup->plant.start.translation(), sim::RobotModel::p3dx().swing_radius_m)
          .visible;
  auto report = command.robots == 1 ? run_alone(command, std::move(*world), title, *setup, visible, hooks)
                                    : run_together(command, std::move(*world), title, *setup, visible, hooks);
  if (report && !command.calibration.empty()) (*report)["calibration"] = command.calibration;
  if (!report || !command.bound) return report;
  if (auto added = add_bound(command, setup->plant.start, *report); !added)
    return tl::unexpected(added.error());
  return report;
}

types::Status run_explore(const ExploreCommand& command) {
  Progress progress;
  const auto report = explore(command, progress);
  if (!report) return tl::unexpected(report.error());
  fmt::print("{}\n", command.json ? report->dump() : report->dump(2));
  return {};
}

}  // namespace topo::bench
