// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "tests/bench/topobench/slam_command.hpp"

namespace {

/// 2 is the user's fault, 1 everything else.
int exit_status(const topo::types::Error& error) {
  using topo::types::Errc;
  const bool users =
      error.code == Errc::kInvalidInput || error.code == Errc::kNotFound || error.code == Errc::kPermission;
  return users ? 2 : 1;
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

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  if (*slam_app) {
    if (const auto done = topo::bench::run_slam(slam); !done) {
      fmt::print(stderr, "topobench: {}\n", done.error().message);
      return exit_status(done.error());
    }
  }
  return 0;
}
