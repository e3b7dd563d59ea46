// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/goals/goals_command.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "daemon/mapfile/overview.hpp"
#include "daemon/mapfile/picture.hpp"
#include "tests/bench/topobench/explore/explore_command.hpp"
#include "tests/bench/topobench/goals/goal_stages.hpp"
#include "tests/bench/topobench/output.hpp"
#include "tests/bench/topobench/table/table_world.hpp"
#include "tests/sim/area.hpp"
#include "tests/sim/robot_model.hpp"

namespace topo::bench {
namespace {

using nlohmann::json;

constexpr std::size_t kClustersMin = 8;  // fewer are a handful by themselves

types::Result<std::vector<TableWorld>> worlds_of(const GoalsCommand& command) {
  const auto files = world_files(command.worlds);
  if (!files) return tl::unexpected(files.error());
  std::vector<TableWorld> worlds;
  for (const std::filesystem::path& file : *files) {
    auto world = load_table_world(file, command.seeds, true, 1);
    if (!world) return tl::unexpected(world.error());
    worlds.push_back(std::move(*world));
  }
  return worlds;
}

types::Result<std::vector<GoalStage>> stages_of(const TableWorld& table_world, const GoalsCommand& command,
                                                std::uint64_t seed) {
  const auto world = sim::World::load(table_world.file);
  if (!world) return tl::unexpected(world.error());
  const sim::Se2& start = table_world.starts[seed - 1];
  const double radius_m = sim::RobotModel::p3dx().swing_radius_m;
  sim::ReachableArea area = reachable_area(*world, start.translation(), radius_m);
  GoalStages stages(drivable_truth(std::move(area.poses), radius_m), start, area.visible.area_m2(),
                    command.stages);
  ExploreCommand explore;
  explore.world = table_world.file;
  explore.seed = seed;
  explore.fidelity = command.fidelity;
  explore.start = {start.x_m, start.y_m, start.theta_rad};
  if (auto report = bench::explore(explore, stages); !report) return tl::unexpected(report.error());
  return stages.stages();
}

json openings_without_goal(const GoalStage& stage) {
  json openings = json::array();
  for (const OpeningOntoSpace& o : stage.onto_space.openings) {
    if (o.has_goal) continue;
    openings.push_back({{"x_m", o.p_map.x()},
                        {"y_m", o.p_map.y()},
                        {"width_m", o.width_m},
                        {"space_m2", o.space_m2},
                        {"why", o.why}});
  }
  return openings;
}

struct Sums {
  std::size_t maps = 0, clusters = 0, goals = 0, onto_space = 0, openings = 0, without_goal = 0;
  double goals_a_cluster_max = 0.0;  ///< of all maps that count

  void add(const GoalStage& stage, std::size_t without) {
    openings += stage.onto_space.openings.size();
    without_goal += without;
    if (stage.clusters < kClustersMin) return;
    ++maps;
    clusters += stage.clusters;
    goals += stage.goals;
    onto_space += stage.onto_space.goals;
    goals_a_cluster_max =
        std::max(goals_a_cluster_max, static_cast<double>(stage.goals) / static_cast<double>(stage.clusters));
  }
  [[nodiscard]] json to_json() const {
    json out{{"maps", maps},         {"frontier_clusters", clusters},
             {"goals", goals},       {"goals_onto_space", onto_space},
             {"openings", openings}, {"openings_without_goal", without_goal}};
    if (clusters > 0) {
      out["goals_a_cluster"] = static_cast<double>(goals) / static_cast<double>(clusters);
      out["goals_a_cluster_max"] = goals_a_cluster_max;
    }
    return out;
  }
};

types::Status save_picture(const GoalsCommand& command, const std::string& name, const GoalStage& stage) {
  if (command.out.empty()) return {};
  return daemon::save_png((command.out / (name + ".png")).string(),
                          daemon::overview_of(*stage.analysis, {}, stage.analysis->goals.goals));
}

}  // namespace

types::Status run_goals(const GoalsCommand& command) {
  const auto worlds = worlds_of(command);
  if (!worlds) return tl::unexpected(worlds.error());
  if (auto made = make_folder(command.out); !made) return made;
  Sums sums;
  json each = json::array();
  for (const TableWorld& world : *worlds) {
    for (int seed = 1; seed <= command.seeds; ++seed) {
      const auto stages = stages_of(world, command, static_cast<std::uint64_t>(seed));
      if (!stages) return tl::unexpected(stages.error());
      for (const GoalStage& stage : *stages) {
        json without = openings_without_goal(stage);
        sums.add(stage, without.size());
        const std::string name = fmt::format("{}-{}-{:.0f}s", world.name, seed, stage.t_s);
        fmt::print(stderr,
                   "{}: {:.0f} % known, {} clusters, {} goals, {} openings onto space, {} without goal\n",
                   name, 100.0 * stage.known, stage.clusters, stage.goals, stage.onto_space.openings.size(),
                   without.size());
        if (!without.empty()) {
          if (auto saved = save_picture(command, name, stage); !saved) return saved;
        }
        each.push_back({{"map", name},
                        {"known", stage.known},
                        {"frontier_clusters", stage.clusters},
                        {"goals", stage.goals},
                        {"goals_onto_space", stage.onto_space.goals},
                        {"openings", stage.onto_space.openings.size()},
                        {"without_goal", std::move(without)}});
      }
    }
  }
  json printed = sums.to_json();
  printed["each"] = std::move(each);
  fmt::print("{}\n", command.json ? printed.dump() : printed.dump(2));
  return {};
}

}  // namespace topo::bench
