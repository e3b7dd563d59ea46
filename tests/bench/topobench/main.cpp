// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "tests/bench/topobench/explore/explore_command.hpp"
#include "tests/bench/topobench/slam_command.hpp"

namespace {

/// 2 is the user's fault, 1 everything else.
int exit_status(const topo::types::Error& error) {
  using topo::types::Errc;
  const bool users =
      error.code == Errc::kInvalidInput || error.code == Errc::kNotFound || error.code == Errc::kPermission;
  return users ? 2 : 1;
}

void add_options(CLI::App& app, topo::bench::ExploreCommand& explore) {
  app.add_option("--world", explore.world, "The building: a map_server YAML file or a drawn scene (.toml)")
      ->required();
  app.add_option("--robots", explore.robots, "How many robots: 1 for the time being")->capture_default_str();
  app.add_option("--strategy", explore.strategy)
      ->check(CLI::IsMember({"topometric", "nearest_frontier"}))
      ->capture_default_str();
  app.add_option("--seed", explore.seed, "Of noise, slip and wheel errors")->capture_default_str();
  app.add_option("--fidelity", explore.fidelity,
                 "full: every scan, and SLAM; plan: 5 Hz, 270 beams, the true pose with a bounded error")
      ->check(CLI::IsMember({"full", "plan"}))
      ->capture_default_str();
  app.add_option("--finish", explore.finish, "essential: home when the paper's goals are visited")
      ->check(CLI::IsMember({"essential", "complete"}))
      ->capture_default_str();
  app.add_option("--limit", explore.limit_s, "Seconds of the robot's time")->capture_default_str();
  app.add_option("--start", explore.start, "X,Y,THETA in metres and radians; else the world's first")
      ->delimiter(',');
  app.add_option("--out", explore.out, "Folder for pictures, decisions, path and map");
  app.add_flag("--json", explore.json, "One JSON object on one line");
}

int finish(const topo::types::Status& done) {
  if (done) return 0;
  fmt::print(stderr, "topobench: {}\n", done.error().message);
  return exit_status(done.error());
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"topobench: what Topometric's parts do on recorded data"};
  app.require_subcommand(1);

  topo::bench::SlamCommand slam;
  CLI::App* slam_app =
      app.add_subcommand("slam", "Map a CARMEN log (.clf, .clf.bz2, .clf.gz) or a Mines URG log (.dat.bz2)");
  slam_app->add_option("--log", slam.log, "The log")->required();
  slam_app->add_option("--relations", slam.relations,
                       "True relations (Kuemmerle et al. 2009) to measure against");
  slam_app->add_option("--out", slam.out, "Folder for map.pgm, map.yaml, map.png and trajectory.txt");
  slam_app->add_flag("--json", slam.json, "One JSON object on one line");

  topo::bench::ExploreCommand explore;
  CLI::App* explore_app =
      app.add_subcommand("explore", "Explore a simulated building in lock-step, faster than real time");
  add_options(*explore_app, explore);

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  return finish(*slam_app ? topo::bench::run_slam(slam) : topo::bench::run_explore(explore));
}
