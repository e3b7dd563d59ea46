// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/bench/topobench/slam_command.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>

#include "core/slam/doubt/map_doubt.hpp"
#include "core/slam/doubt/revisit.hpp"
#include "core/types/se2.hpp"
#include "daemon/mapfile/doubt_json.hpp"
#include "tests/bench/topobench/explore/calibrated_setup.hpp"
#include "tests/bench/topobench/log_run.hpp"
#include "tests/bench/topobench/output.hpp"
#include "tests/bench/topobench/slam/canonical_share.hpp"
#include "tests/bench/topobench/slam/log_relations.hpp"
#include "tests/bench/topobench/slam/slam_report.hpp"
#include "tests/bench/topobench/slam/split_run.hpp"

namespace topo::bench {
namespace {

double degrees(double rad) { return rad / types::kDegree_rad; }

using Relations = std::vector<Relation>;

types::Result<Relations> relations_of(const SlamCommand& command, const CarmenLog& log) {
  if (command.relations.empty()) return Relations();
  return read_relations_of(log, command.relations);
}

nlohmann::json relation_errors(const Relations& relations, std::span<const TimedPose> trajectory) {
  const RelationErrors errors = evaluate_relations(relations, trajectory);
  return nlohmann::json{{"used", errors.used},
                        {"skipped", errors.skipped},
                        {"trans_mean_m", errors.trans_mean_m},
                        {"trans_std_m", errors.trans_std_m},
                        {"trans_max_m", errors.trans_max_m},
                        {"rot_mean_deg", degrees(errors.rot_mean_rad)},
                        {"rot_std_deg", degrees(errors.rot_std_rad)},
                        {"rot_max_deg", degrees(errors.rot_max_rad)}};
}

nlohmann::json split_report(const SlamCommand& command, const CarmenLog& log, const MappingRun& alone,
                            const Relations& relations) {
  std::optional<types::Se2> second_start;
  if (command.split == "known") second_start = alone.trajectory[log.scans.size() / 2].pose;
  const SplitRun run = run_split(log, second_start);
  nlohmann::json json{{"starts", command.split},
                      {"keyframes", run.keyframes},
                      {"mates_keyframes", run.mates_keyframes},
                      {"ties", run.ties},
                      {"alignments", run.alignments}};
  json["joined_share"] = run.joined_share ? nlohmann::json(*run.joined_share) : nlohmann::json(nullptr);
  if (!relations.empty()) json["relations"] = relation_errors(relations, run.trajectory);
  return json;
}

slam::ScanCount scan_count(const MappingRun& run) {
  return {run.trajectory.size(), static_cast<std::uint64_t>(run.lost),
          static_cast<std::uint64_t>(run.degenerate)};
}

/// How the map agrees with itself, and what speaks against it.
slam::MapDoubt judge(nlohmann::json& json, pipeline::MappingState& state, const MappingRun& run) {
  const slam::Mapper& mapper = state.mapper();
  const auto snapshot = state.make_snapshot();
  json["unlike_canonical"] = unlike_canonical_share(mapper, snapshot->grid);
  const slam::RevisitShare revisits = slam::revisit_share(mapper.keyframes(), mapper.poses(), snapshot->grid);
  if (revisits.points > 0) json["revisit_within_0_1_m"] = revisits.share();
  json["revisit_points"] = revisits.points;
  slam::MapDoubt doubt =
      slam::doubt_of(mapper.session(), mapper.own_way(), mapper.params().graph, scan_count(run), revisits);
  json["doubt"] = daemon::doubt_json(doubt);
  return doubt;
}

types::Status finish(const SlamCommand& command, nlohmann::json& json, pipeline::MappingState& state,
                     const MappingRun& run) {
  const slam::MapDoubt doubt = judge(json, state, run);
  if (!command.out.empty()) {
    auto written = write_map_files(command.out, *state.make_snapshot(), state.mapper(), run);
    if (!written) return written;
  }
  if (doubt.is_doubted()) fmt::print(stderr, "topobench: {}\n", daemon::doubt_text(doubt));
  fmt::print("{}\n", command.json ? json.dump() : json.dump(2));
  return {};
}

types::Status map_log(const SlamCommand& command) {
  const StageTimer timer;
  auto log = read_log(command.log, options_of(command.beams_deg));
  if (!log) return tl::unexpected(log.error());
  print_remarks(command.log, *log);
  StageTimes reading;
  timer.stop({&reading});
  auto relations = relations_of(command, *log);
  if (!relations) return tl::unexpected(relations.error());
  if (!command.thinning.none()) {
    thin(*log, command.thinning);
    *relations = between_scans(*relations, *log);
  }
  if (auto made = make_folder(command.out); !made) return made;
  pipeline::MappingState state(params_for(*log));
  const MappingRun run = run_log(*log, state);
  nlohmann::json json = report_of(state, run);
  json["log"] = command.log;
  json["scans"] = log->scans.size();
  json["stamp_inversions"] = log->stamp_inversions;
  if (log->foreign_lines > 0) json["foreign_lines"] = log->foreign_lines;
  if (log->readings_beyond > 0) {
    json["range_limit_m"] = log->range_limit_m;
    json["readings_beyond_limit"] = log->readings_beyond;
  }
  json["read_cpu_s"] = 1e-3 * reading.cpu_ms.front();
  if (!relations->empty()) json["relations"] = relation_errors(*relations, run.trajectory);
  if (!command.split.empty()) json["split"] = split_report(command, *log, run, *relations);
  return finish(command, json, state, run);
}

/// Wheels that are so many times as false, and slip so many times as often.
sim::Difficulty with_wheels(double hardship) {
  sim::Difficulty difficulty;
  difficulty.wheel_scale_error *= hardship;
  difficulty.track_error *= hardship;
  difficulty.slip_interval_s /= hardship;
  return difficulty;
}

/// The robot that drives, and what its mapper is told of it.
struct SimulatedRobot {
  SimulatedSetup setup;
  sim::Difficulty difficulty;
  slam::MapperParams mapper = simulated_robot_params();
};

types::Result<SimulatedRobot> robot_of(const SlamCommand& command) {
  SimulatedRobot robot{{command.minutes, command.seed, command.people, {.arrived_m = 0.10}},
                       with_wheels(command.hardship)};
  robot.setup.limits.acceleration_mps2 = command.acceleration_mps2;
  robot.setup.thinning = command.thinning;
  if (command.calibration.empty()) return robot;
  const auto calibrated = calibrated_setup(command.calibration, {}, command.seed);
  if (!calibrated) return tl::unexpected(calibrated.error());
  robot.setup.T_base_laser = calibrated->plant.mapping.T_base_laser;
  robot.setup.driver = calibrated->plant.driver;
  robot.difficulty = calibrated->plant.difficulty;
  robot.mapper = calibrated->mind.mapping;
  return robot;
}

types::Status map_simulation(const SlamCommand& command) {
  auto world = sim::World::load(command.simulate);
  if (!world) return tl::unexpected(world.error());
  auto robot = robot_of(command);
  if (!robot) return tl::unexpected(robot.error());
  if (auto made = make_folder(command.out); !made) return made;
  sim::Simulation simulation(std::move(*world), robot->difficulty, command.seed);
  pipeline::MappingState state(robot->mapper);
  const auto simulated = run_simulated(simulation, robot->setup, state);
  if (!simulated) return tl::unexpected(simulated.error());
  nlohmann::json json = report_of(state, simulated->run);
  json["world"] = command.simulate.string();
  json["seed"] = command.seed;
  json["people"] = command.people;
  if (!command.calibration.empty()) json["calibration"] = command.calibration;
  json["difficulty"] = simulation.difficulty().text();
  json["scans"] = simulated->scans;
  json["true_path_m"] = simulated->path_m;
  json["odometry_off_m"] = simulated->odometry_m;
  json["collisions"] = simulated->collisions;
  json["error"] = error_report(simulated->corrected);
  json["live_error"] = error_report(simulated->live);
  return finish(command, json, state, simulated->run);
}

}  // namespace

types::Status run_slam(const SlamCommand& command) {
  return command.simulate.empty() ? map_log(command) : map_simulation(command);
}

}  // namespace topo::bench
