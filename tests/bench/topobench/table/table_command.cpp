// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/table/table_command.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <thread>

#include "daemon/mapfile/atomic_file.hpp"
#include "tests/bench/topobench/explore/contender.hpp"
#include "tests/bench/topobench/explore/explore_command.hpp"
#include "tests/bench/topobench/explore/radio.hpp"
#include "tests/bench/topobench/fresh/suite.hpp"
#include "tests/bench/topobench/output.hpp"
#include "tests/bench/topobench/table/fingerprint.hpp"
#include "tests/bench/topobench/table/mean_coverage.hpp"
#include "tests/bench/topobench/table/progress_line.hpp"
#include "tests/bench/topobench/table/table_bounds.hpp"
#include "tests/bench/topobench/table/table_text.hpp"

namespace topo::bench {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using types::Errc;
using types::fail;

constexpr int kTableRobotsMax = 8;

types::Status check(const TableCommand& command) {
  pipeline::PlannerParams scratch;
  for (const std::string& strategy : command.strategies) {
    if (auto known = set_contender(strategy, scratch); !known) return known;
  }
  const std::set<std::string> strategies(command.strategies.begin(), command.strategies.end());
  const std::set<int> robots(command.robots.begin(), command.robots.end());
  if (strategies.empty() || strategies.size() != command.strategies.size())
    return fail(Errc::kInvalidInput, "--strategies: expected different ones, at least one");
  if (robots.empty() || robots.size() != command.robots.size() || *robots.begin() < 1 ||
      *robots.rbegin() > kTableRobotsMax)
    return fail(Errc::kInvalidInput,
                fmt::format("--robots: expected different numbers from 1 to {}", kTableRobotsMax));
  if (*robots.rbegin() > 1 && command.fidelity != "plan")
    return fail(Errc::kInvalidInput,
                fmt::format("--fidelity: found {} for several robots, expected plan", command.fidelity));
  if (command.seeds < 1)
    return fail(Errc::kInvalidInput, fmt::format("--seeds: found {}, expected 1 or more", command.seeds));
  if (auto limit = check_limit(command.limit_s); !limit) return limit;
  if (command.suite == "fresh" ? !command.worlds.empty() : command.worlds.empty())
    return fail(Errc::kInvalidInput, "--worlds: expected worlds, or --suite fresh in their place");
  if ((command.suite == "fresh") != command.suite_seed.has_value())
    return fail(Errc::kInvalidInput, "--suite-seed: expected one with --suite fresh, and with nothing else");
  if (command.out.empty()) return fail(Errc::kInvalidInput, "--out: expected a folder for the runs");
  if (command.wall_limit_s < 1)
    return fail(Errc::kInvalidInput,
                fmt::format("--wall-limit: found {}, expected seconds from 1 up", command.wall_limit_s));
  for (const std::string& text : command.radios) {
    if (const auto radio = parse_radio(text); !radio) return tl::unexpected(radio.error());
  }
  const std::set<std::string> radios(command.radios.begin(), command.radios.end());
  if (radios.empty() || radios.size() != command.radios.size())
    return fail(Errc::kInvalidInput, "--radio: expected different ones, at least one");
  return {};
}

/// The one asked for, else the one that the robots are to reach before they come home.
types::Result<Time> share_of(const TableCommand& command) {
  if (command.share.empty()) return command.finish == "complete" ? Time::kT99 : Time::kT95;
  for (std::size_t i = 0; i < static_cast<std::size_t>(Time::kHome); ++i) {
    if (command.share == kTimeNames[i]) return static_cast<Time>(i);
  }
  return fail(Errc::kInvalidInput,
              fmt::format("--share: found {}, expected t50, t90, t95 or t99", command.share));
}

/// Of the suite, or what was named. Fresh buildings stand in a folder beside the runs; drawing them again
/// changes nothing.
types::Result<std::vector<fs::path>> files_of(const TableCommand& command) {
  if (command.suite == "fresh") {
    const fs::path folder = command.out / "worlds";
    if (auto made = make_folder(folder); !made) return tl::unexpected(made.error());
    return fresh::write_fresh_suite(*command.suite_seed, command.buildings, folder);
  }
  if (command.suite != "dev") return world_files(command.worlds);
  if (command.worlds.size() == 1) return fresh::dev_suite(command.worlds.front());
  return fail(Errc::kInvalidInput,
              fmt::format("--suite dev: found {} --worlds, expected one: the folder of the "
                          "public plans",
                          command.worlds.size()));
}

types::Result<std::vector<TableWorld>> worlds_of(const TableCommand& command) {
  const auto files = files_of(command);
  if (!files) return tl::unexpected(files.error());
  const int team = *std::max_element(command.robots.begin(), command.robots.end());
  std::vector<TableWorld> worlds;
  for (const fs::path& file : *files) {
    auto world = load_table_world(file, command.seeds, command.starts == "drawn", team);
    if (!world) return tl::unexpected(world.error());
    const bool fits =
        world->reachable_m2 >= command.area_min_m2 && world->reachable_m2 <= command.area_max_m2;
    fmt::print(stderr, "{}: {:.0f} m2 can be reached{}\n", world->name, world->reachable_m2,
               fits ? "" : ", left out");
    if (fits) worlds.push_back(std::move(*world));
  }
  if (worlds.empty())
    return fail(Errc::kNotFound,
                fmt::format("--worlds: found none of {} to {} m2", command.area_min_m2, command.area_max_m2));
  return worlds;
}

/// Which program's runs: this one's, or without any to be done those that are there.
types::Result<std::string> program_of(const TableCommand& command, const RunLog& log) {
  if (!command.program.empty()) return command.program;
  if (!command.no_runs || log.programs().empty()) return fingerprint_of_program();
  if (log.programs().size() == 1) return *log.programs().begin();
  return fail(Errc::kInvalidInput, fmt::format("--no-runs: found runs of the programs {} in {}, expected "
                                               "--program with one of them",
                                               fmt::join(log.programs(), ", "), command.out.string()));
}

types::Result<RunKey> common_key(const TableCommand& command, const RunLog& log) {
  const auto program = program_of(command, log);
  if (!program) return tl::unexpected(program.error());
  RunKey key;
  key.program = *program;
  key.fidelity = command.fidelity;
  key.finish = command.finish;
  key.limit_s = command.limit_s;
  return key;
}

types::Result<json> explore_one(const PlannedRun& run) {
  ExploreCommand command;
  command.world = run.file;
  command.robots = run.key.entrant.robots;
  command.strategy = run.key.entrant.strategy;
  command.seed = run.key.seed;
  command.fidelity = run.key.fidelity;
  command.finish = run.key.finish;
  command.limit_s = run.key.limit_s;
  command.radio = run.key.entrant.radio;
  command.start = {run.key.start.x_m, run.key.start.y_m, run.key.start.theta_rad};
  RunHooks nobody;
  return explore(command, nobody);
}

types::Result<std::vector<Contest>> contests_of(const TableCommand& command,
                                                std::span<const Entrant> entrants) {
  if (command.compare.empty()) return usual_contests(entrants);
  std::vector<Contest> contests;
  for (const std::string& text : command.compare) {
    auto contest = parse_contest(text, entrants);
    if (!contest) return tl::unexpected(contest.error());
    contests.push_back(std::move(*contest));
  }
  return contests;
}

types::Status write_pictures(const TableCommand& command, std::span<const TableRun> runs,
                             std::vector<std::string> worlds) {
  worlds.emplace_back();
  for (const int robots : command.robots) {
    std::vector<Entrant> entrants = entrants_of(command.strategies, {&robots, 1}, command.radios);
    std::erase_if(entrants, [first = entrants.front()](const Entrant& entrant) {
      return entrant.strategy != first.strategy && entrant.radio != first.radio;
    });
    for (const std::string& world : worlds) {
      const std::string name = fmt::format("coverage-{}-{}.png", world.empty() ? "all" : world, robots);
      const auto curves = mean_coverage(runs, entrants, world);
      if (auto saved = picture_of(curves).save_png(command.out / name); !saved) return saved;
    }
  }
  return {};
}

types::Status write_table(const TableCommand& command, const Table& table) {
  const std::string text = text_of(table), object = json_of(table).dump();
  if (auto saved = daemon::write_file((command.out / "table.md").string(), text); !saved) return saved;
  if (auto saved = daemon::write_file((command.out / "table.json").string(), object); !saved) return saved;
  fmt::print("{}\n", command.json ? object : text);
  return {};
}

/// What all runs have in common.
json setup_of(const TableCommand& command, const RunKey& common) {
  json setup{{"program", common.program},   {"seeds", command.seeds},  {"starts", command.starts},
             {"fidelity", common.fidelity}, {"finish", common.finish}, {"limit_s", common.limit_s}};
  if (!command.suite.empty()) setup["suite"] = command.suite;
  if (command.suite == "fresh") setup["suite_seed"] = *command.suite_seed;
  return setup;
}

Table table_of(std::span<const TableWorld> worlds, std::span<const Entrant> entrants,
               std::span<const Contest> contests, std::span<const TableRun> runs) {
  Table table;
  for (const Entrant& entrant : entrants) table.averages.push_back(average_of(entrant, runs));
  for (const TableWorld& world : worlds) {
    std::vector<TableRun> there;
    std::copy_if(runs.begin(), runs.end(), std::back_inserter(there),
                 [&](const TableRun& run) { return run.world == world.name; });
    table.worlds.push_back(world.name);
    table.by_world.emplace_back();
    for (const Entrant& entrant : entrants) table.by_world.back().push_back(average_of(entrant, there));
  }
  for (const Contest& contest : contests) table.comparisons.push_back(compare(runs, contest));
  std::copy_if(runs.begin(), runs.end(), std::back_inserter(table.failures),
               [](const TableRun& run) { return run.failed; });
  return table;
}

std::vector<Breakdown> breakdowns_of(std::span<const Entrant> entrants, std::span<const TableRun> runs,
                                     const Bounds& bounds) {
  std::vector<BrokenDown> parts;
  for (const TableRun& run : runs) {
    if (run.parts) parts.push_back({run.world, run.seed, run.entrant, *run.parts});
  }
  std::vector<Breakdown> rows;
  for (const Entrant& entrant : entrants) rows.push_back(breakdown_of(entrant, parts, bounds));
  return rows;
}

WorkerLimits limits_of(const TableCommand& command) {
  const int processors = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  return {command.jobs > 0 ? command.jobs : processors, std::chrono::seconds(command.wall_limit_s)};
}

/// What a team with full knowledge needs, remembered in bounds.jsonl.
types::Result<Bounds> bounds_of(const TableCommand& command, std::span<const TableWorld> worlds) {
  auto log = RunLog::open(command.out / "bounds.jsonl");
  if (!log) return tl::unexpected(log.error());
  return table_bounds(worlds, command.robots, limits_of(command), !command.no_runs, *log);
}

/// The finished runs, after those that were missing are done.
types::Result<std::vector<TableRun>> runs_of(const TableCommand& command, std::span<const PlannedRun> planned,
                                             RunLog& log, Time share) {
  if (!command.no_runs) {
    ProgressLine progress;
    if (auto done = do_runs(planned, limits_of(command), explore_one, log, progress); !done)
      return tl::unexpected(done.error());
  }
  auto runs = table_runs_of(planned, log, share);
  if (runs && runs->empty())
    return fail(Errc::kNotFound,
                fmt::format("--out: found none of the {} runs in {}, which has {} of other programs or with "
                            "other options; expected the options that they were made with",
                            planned.size(), command.out.string(), log.size()));
  return runs;
}

}  // namespace

types::Status run_table(const TableCommand& command) {
  if (auto status = check(command); !status) return status;
  const auto share = share_of(command);
  if (!share) return tl::unexpected(share.error());
  const std::vector<Entrant> entrants = entrants_of(command.strategies, command.robots, command.radios);
  const auto contests = contests_of(command, entrants);
  if (!contests) return tl::unexpected(contests.error());
  if (auto made = make_folder(command.out); !made) return made;
  auto log = RunLog::open(command.out / "runs.jsonl");
  if (!log) return tl::unexpected(log.error());
  if (log->strange_lines() > 0)
    fmt::print(stderr, "runs.jsonl: {} lines are no runs and are not looked at\n", log->strange_lines());
  const auto common = common_key(command, *log);
  if (!common) return tl::unexpected(common.error());
  const auto worlds = worlds_of(command);
  if (!worlds) return tl::unexpected(worlds.error());
  const auto runs = runs_of(command, plan_runs(*worlds, entrants, *common), *log, *share);
  if (!runs) return tl::unexpected(runs.error());
  Table table = table_of(*worlds, entrants, *contests, *runs);
  const auto bounds = bounds_of(command, *worlds);
  if (!bounds) return tl::unexpected(bounds.error());
  table.breakdowns = breakdowns_of(entrants, *runs, *bounds);
  table.setup = setup_of(command, *common);
  table.share = kTimeNames[static_cast<std::size_t>(*share)];
  if (auto written = write_pictures(command, *runs, table.worlds); !written) return written;
  return write_table(command, table);
}

}  // namespace topo::bench
