// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/table_options.hpp"

#include "core/exploration/finish.hpp"

#include "tests/bench/topobench/explore/contender.hpp"

namespace topo::bench {

CLI::Validator not_empty() {
  const auto fault = [](const std::string& path) {
    return path.empty() ? std::string("found an empty path, expected one") : std::string();
  };
  return {fault, "PATH"};
}

CLI::Validator finish_form() {
  const auto fault = [](const std::string& text) {
    const auto parsed = exploration::parse_finish(text);
    return parsed ? std::string() : parsed.error().message;
  };
  return {fault, "FINISH"};
}

void add_options(CLI::App& app, TableCommand& table) {
  app.add_option("--worlds", table.worlds,
                 "Buildings: files as explore --world has them, and folders of them")
      ->delimiter(',');
  auto* suite =
      app.add_option("--suite", table.suite,
                     "fresh: buildings drawn from --suite-seed, in the manner of the public plans; dev: the "
                     "public plans, on which\nparameters were developed, in the folder --worlds")
          ->check(CLI::IsMember({"fresh", "dev"}));
  app.add_option("--suite-seed", table.suite_seed,
                 "To be drawn after the commit under test, and named with its figures")
      ->needs(suite)
      ->check(CLI::NonNegativeNumber);
  app.add_option("--buildings", table.buildings, "Of a fresh suite")->capture_default_str();
  app.add_option("--strategies", table.strategies,
                 "As explore --strategy; the first is held against the others")
      ->delimiter(',')
      ->capture_default_str();
  app.add_option("--robots", table.robots, "Numbers of robots")->delimiter(',')->capture_default_str();
  app.add_option("--seeds", table.seeds, "Seeds 1 to N, each in every world")->capture_default_str();
  app.add_option("--starts", table.starts,
                 "drawn: seed 1 from the world's own start, every other from one that it draws where three "
                 "robots have room;\n"
                 "own: all from the world's own. That is the one in a WORLDS.tsv beside the world (name, "
                 "start_x_m, start_y_m),\nelse the world's first")
      ->check(CLI::IsMember({"drawn", "own"}))
      ->capture_default_str();
  app.add_option("--fidelity", table.fidelity)->check(CLI::IsMember({"full", "plan"}))->capture_default_str();
  app.add_option("--finish", table.finish, "As explore --finish, for all strategies")
      ->check(finish_form())
      ->capture_default_str();
  app.add_option("--radio", table.radios, "As explore --radio has it; several: each")
      ->delimiter(',')
      ->capture_default_str();
  app.add_option("--limit", table.limit_s, "Seconds of the robots' time, and what a failure counts as")
      ->capture_default_str();
  app.add_option("--min-area", table.area_min_m2, "m2 that can be reached, of worlds that take part")
      ->capture_default_str();
  app.add_option("--max-area", table.area_max_m2, "m2")->capture_default_str();
  app.add_option(
         "--share", table.share,
         "A run that does not get there has failed; else t99 with --finish complete, t95 with essential")
      ->check(CLI::IsMember({"t50", "t90", "t95", "t99"}));
  app.add_option("--compare", table.compare,
                 "STRATEGY:ROBOTS[:RADIO]/STRATEGY:ROBOTS[:RADIO], several; best_baseline is in every world "
                 "the best of "
                 "those that\nare not topometric. Else the first strategy against the others and the best "
                 "baseline with "
                 "as many robots, against\nall with one robot, and against itself with the first radio")
      ->delimiter(',');
  app.add_option("--jobs", table.jobs, "Runs at once; 0: as many as there are processors")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  app.add_option("--wall-limit", table.wall_limit_s,
                 "Seconds by the clock; a run that takes longer has failed")
      ->capture_default_str();
  app.add_flag("--no-runs", table.no_runs,
               "The table of the runs that are there already, of whatever program they are");
  app.add_option("--program", table.program,
                 "Takes a name in place of this program's fingerprint: whoever gives the same name to two "
                 "programs says\nthat both decide the same");
  app.add_option("--out", table.out, "Folder for runs.jsonl, table.md, table.json and pictures")
      ->required()
      ->check(not_empty());
  app.add_flag("--json", table.json, "One JSON object on one line");
}

void add_options(CLI::App& app, BoundCommand& bound) {
  app.footer(
      "m_per_robot: way of the robot that drives farthest, until a share of the reachable area was seen, of "
      "tours\n"
      "that were found (feasible: they see 99 %): a greedy cover by places to look from, shared out. The "
      "true limit\n"
      "is lower; lower_m_per_robot is below it. own_motion: with the robot's accelerations, turning on the "
      "spot at\n"
      "sharp corners.");
  app.add_option("--world", bound.world, "The building: a map_server YAML file or a drawn scene (.toml)")
      ->required();
  app.add_option("--robots", bound.robots, "1 to 8, who enter as in explore")->capture_default_str();
  app.add_option("--start", bound.start, "X,Y,THETA in metres and radians; else the world's first")
      ->delimiter(',');
  app.add_option("--picture", bound.picture, "PNG of the tours")->check(not_empty());
  app.add_flag("--json", bound.json, "One JSON object on one line");
}

void add_options(CLI::App& app, SuiteCommand& suite) {
  app.add_option("--suite", suite.suite,
                 "fresh: drawn from --seed; dev: the public plans that were developed on")
      ->check(CLI::IsMember({"fresh", "dev"}))
      ->capture_default_str();
  app.add_option("--seed", suite.seed, "Of the buildings: one that no decision was made by")
      ->capture_default_str()
      ->check(CLI::NonNegativeNumber);
  app.add_option("--buildings", suite.buildings, "Of a fresh suite")->capture_default_str();
  app.add_option("--plans", suite.plans, "Folder of the public plans, to print beside");
  app.add_option("--out", suite.out, "Folder for the buildings: PNG and map_server YAML each")
      ->check(not_empty());
}

}  // namespace topo::bench
