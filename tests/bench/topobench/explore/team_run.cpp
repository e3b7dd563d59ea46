// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/explore/team_run.hpp"

#include <algorithm>
#include <deque>
#include <map>
#include <utility>

#include "core/slam/map_builder.hpp"
#include "tests/bench/topobench/explore/robot_run.hpp"
#include "tests/bench/topobench/stopwatch.hpp"
#include "tests/sim/simulation.hpp"
#include "tests/sim/team_start.hpp"

namespace topo::bench {
namespace {

using pipeline::Activity;

constexpr sim::SimTime kExchangePeriod = std::chrono::milliseconds(200);  // the daemon's is shorter

/// One robot with all that is its own. Stays where it is: its parts refer to one another.
struct Member {
  RunSetup setup;
  types::Se2 T_common_map;  ///< its map in the frame of the first robot's: for measuring alone
  std::unique_ptr<Plant> plant;
  SharedMapSource* source = nullptr;  ///< the mind's
  std::unique_ptr<RobotMind> mind;
  std::unique_ptr<TeamNode> node;
  std::unique_ptr<RobotRun> run;
};

/// A map of what robots saw themselves, each keyframe where its origin has it.
class Drawing {
 public:
  explicit Drawing(const RunSetup& setup, const sim::Raster& visible)
      : builder_(setup.mind.mapping.grid),
        coverage_(visible, setup.plant.start, setup.mind.mapping.grid.resolution_m) {}

  void add(const slam::KeyframePtr& keyframe, const Member& origin) {
    keyframes_.push_back(keyframe);
    makers_.push_back(&origin);
  }
  void update() {
    poses_.clear();
    for (std::size_t i = 0; i < keyframes_.size(); ++i)
      poses_.push_back(makers_[i]->T_common_map * *makers_[i]->source->find_pose(keyframes_[i]->id));
    builder_.update(keyframes_, poses_);
    coverage_.update(builder_.grid());
  }
  [[nodiscard]] const Coverage& coverage() const { return coverage_; }

 private:
  slam::MapBuilder builder_;
  std::vector<slam::KeyframePtr> keyframes_;
  std::vector<const Member*> makers_;
  std::vector<types::Se2> poses_;
  Coverage coverage_;  // after builder_: it must go first
};

class TeamRun {
 public:
  TeamRun(std::vector<std::unique_ptr<Member>>& members, const TeamSetup& setup, const sim::Raster& visible)
      : members_(members),
        setup_(setup),
        visible_(visible),
        all_(setup.run, visible),
        drawn_(members.size(), 0),
        noted_(members.size(), 0),
        joined_s_(members.size()),
        radio_(setup.radio, sim::derive_seed(setup.run.plant.seed, 11)) {}

  TeamResult run() {
    double wall_s = 0.0;
    const double cpu_s = cpu_seconds();
    {
      const Stopwatch watch(wall_s);
      const sim::SimTime limit = types::from_seconds(setup_.run.limit_s);
      while (now() < limit && !is_over()) step();
    }
    result_.team.wall_s = wall_s;
    result_.team.cpu_s = cpu_seconds() - cpu_s;
    finish();
    return std::move(result_);
  }

 private:
  struct Sent {
    sim::SimTime due;
    std::uint16_t to;
    std::shared_ptr<const team::Datagram> datagram;
  };

  [[nodiscard]] sim::SimTime now() const { return members_.front()->plant->now(); }
  [[nodiscard]] bool is_over() const {
    return std::all_of(members_.begin(), members_.end(), [](const auto& m) { return m->run->is_over(); });
  }

  void step() {
    for (const auto& member : members_) member->run->tick();
    if (is_due(now(), kExchangePeriod)) exchange();
    if (is_due(now(), kMeasurePeriod)) measure();
  }

  void exchange() {
    for (; !sent_.empty() && sent_.front().due <= now(); sent_.pop_front())
      members_[sent_.front().to]->node->take(*sent_.front().datagram, types::Stamp{now()});
    for (std::uint16_t from = 0; from < members_.size(); ++from) {
      for (team::Datagram& datagram : members_[from]->node->exchange(types::Stamp{now()}))
        broadcast(from, std::make_shared<const team::Datagram>(std::move(datagram)));
      note_truths(from);
    }
  }

  void broadcast(std::uint16_t from, const std::shared_ptr<const team::Datagram>& datagram) {
    const sim::SimTime due = now() + types::from_seconds(setup_.radio.delay_s);
    for (std::uint16_t to = 0; to < members_.size(); ++to) {
      if (from != to && radio_.carries(place(from), place(to), types::to_seconds(now())))
        sent_.push_back({due, to, datagram});
    }
  }

  /// Where the robot truly was at its newest keyframes: a body remembers a second.
  void note_truths(std::uint16_t robot) {
    const auto keyframes = members_[robot]->node->own_keyframes();
    for (; noted_[robot] < keyframes.size(); ++noted_[robot]) {
      const slam::Keyframe& keyframe = *keyframes[noted_[robot]];
      truths_[keyframe.id] = members_[robot]->plant->body().pose_at(keyframe.stamp.time_since_epoch());
    }
  }

  [[nodiscard]] JoinedMap joined_map(std::uint16_t robot) const {
    std::vector<PosePair> all, mates;
    for (const auto& [id, truth] : truths_) {
      const types::Se2* pose = members_[robot]->source->find_pose(id);
      if (pose == nullptr) continue;
      all.push_back({*pose, truth});
      if (id.robot != robot) mates.push_back(all.back());
    }
    const types::Se2 T_building_map = setup_.run.plant.start * members_[robot]->T_common_map;
    return {all.size(), mates.size(), joined_s_[robot], path_error(all, T_building_map),
            path_error(mates, T_building_map)};
  }

  [[nodiscard]] types::Vector2 place(std::uint16_t robot) const {
    return members_[robot]->plant->body().truth().translation();
  }

  /// A robot's own keyframes from the given one on, with what number comes next.
  static std::size_t draw_own(const Member& member, std::size_t from, Drawing& to) {
    const auto keyframes = member.node->own_keyframes();
    for (; from < keyframes.size(); ++from) to.add(keyframes[from], member);
    return from;
  }

  void measure() {
    const Stopwatch watch(result_.team.spent.measuring_s);
    for (std::uint16_t i = 0; i < members_.size(); ++i) {
      drawn_[i] = draw_own(*members_[i], drawn_[i], all_);
      if (!joined_s_[i] && !members_[i]->source->map().mates.empty()) joined_s_[i] = types::to_seconds(now());
    }
    all_.update();
    note_coverage(all_.coverage(), types::to_seconds(now()), result_.team);
    for (const auto& member : members_) {
      member->run->note_pose();
      member->run->note_way(result_.team);
    }
  }

  void finish() {
    RunResult& team = result_.team;
    team.end_s = types::to_seconds(now());
    if (team.coverage.empty() || team.coverage.back().first != team.end_s) measure();
    team.free_fraction = all_.coverage().free_fraction();
    team.covered = all_.coverage().covered();
    team.home = team.mission_ended = true;
    team.activity = Activity::kDone;
    std::vector<sim::Se2> starts;
    for (const auto& member : members_) starts.push_back(member->setup.plant.start);
    for (const auto& member : members_) {
      member->run->finish(starts);
      for (sim::Se2& pose : member->run->result().estimate) pose = member->T_common_map * pose;
      result_.maps.push_back(joined_map(static_cast<std::uint16_t>(result_.maps.size())));
      add(member->run->result());
      result_.robots.push_back(std::move(member->run->result()));
    }
    if (team.home && team.activity == Activity::kDone) team.home_s = team.end_s;
    result_.overlap = overlap();
  }

  void add(const RunResult& robot) {
    RunResult& team = result_.team;
    team.home = team.home && robot.home;
    team.mission_ended = team.mission_ended && robot.mission_ended;
    if (robot.activity != Activity::kDone && team.activity == Activity::kDone) team.activity = robot.activity;
    if (team.reason.empty() || robot.activity != Activity::kDone) team.reason = robot.reason;
    team.home_distance_m = std::max(team.home_distance_m, robot.home_distance_m);
    team.distance_m += robot.distance_m;
    team.time += robot.time;
    team.goals_left += robot.goals_left;
    for (std::size_t i = 0; i < team.way_m.size(); ++i) {
      if (robot.way_m[i]) team.way_m[i] = std::max(team.way_m[i].value_or(0.0), *robot.way_m[i]);
    }
    team.collisions += robot.collisions;
    for (std::size_t i = 0; i < team.doubts.size(); ++i) team.doubts[i] += robot.doubts[i];
    team.worst_lag_s = std::max(team.worst_lag_s, robot.worst_lag_s);
    team.goals_issued += robot.goals_issued;
    team.clusters_sum += robot.clusters_sum;
    team.goals_sum += robot.goals_sum;
    team.decisions_made += robot.decisions_made;
    team.decision_ms.insert(team.decision_ms.end(), robot.decision_ms.begin(), robot.decision_ms.end());
    team.planning_ms.insert(team.planning_ms.end(), robot.planning_ms.begin(), robot.planning_ms.end());
    team.goals.insert(team.goals.end(), robot.goals.begin(), robot.goals.end());
    team.truth.insert(team.truth.end(), robot.truth.begin(), robot.truth.end());
    team.estimate.insert(team.estimate.end(), robot.estimate.begin(), robot.estimate.end());
    team.spent.simulation_s += robot.spent.simulation_s;
    team.spent.mapping_s += robot.spent.mapping_s;
    team.spent.planning_s += robot.spent.planning_s;
    team.spent.control_s += robot.spent.control_s;
  }

  [[nodiscard]] double overlap() const {
    std::vector<int> seen_by(visible_.cells.size(), 0);
    for (std::uint16_t i = 0; i < members_.size(); ++i) {
      Drawing own(setup_.run, visible_);
      draw_own(*members_[i], 0, own);
      own.update();
      const auto& covered = own.coverage().covered().cells;
      for (std::size_t c = 0; c < seen_by.size(); ++c) seen_by[c] += covered[c] != 0 ? 1 : 0;
    }
    const auto any = std::count_if(seen_by.begin(), seen_by.end(), [](int n) { return n > 0; });
    const auto several = std::count_if(seen_by.begin(), seen_by.end(), [](int n) { return n > 1; });
    return any > 0 ? static_cast<double>(several) / static_cast<double>(any) : 0.0;
  }

  std::vector<std::unique_ptr<Member>>& members_;
  const TeamSetup& setup_;
  const sim::Raster& visible_;
  Drawing all_;
  std::vector<std::size_t> drawn_;  ///< of each robot, the next keyframe to be drawn
  std::vector<std::size_t> noted_;  ///< the same of those whose truth has been noted
  std::vector<std::optional<double>> joined_s_;
  std::map<slam::KeyframeId, types::Se2> truths_;  ///< in the building
  Radio radio_;
  std::deque<Sent> sent_;
  TeamResult result_;
};

/// The building that they share: with all devices in fidelity "full".
struct Site {
  std::shared_ptr<sim::World> world;
  std::shared_ptr<sim::Simulation> simulation;  ///< fidelity "full"
  std::vector<sim::Se2> starts;
};

types::Result<std::unique_ptr<Plant>> plant_at(const Site& site, const PlantSetup& setup) {
  return site.simulation != nullptr ? make_full_plant(site.simulation, setup)
                                    : make_sparse_plant(site.world, setup);
}

std::unique_ptr<SharedMapSource> source_of(const Member& member, const TeamSetup& team, std::uint16_t robot,
                                           const std::vector<types::Se2>& starts_map) {
  const RunSetup& setup = member.setup;
  if (setup.fidelity == Fidelity::kPlan) return make_posed_source(setup.mind.mapping, robot);
  return make_slam_source(setup.mind.mapping, setup.closure_delay_scans,
                          {{robot, 0}, team.starts_known ? starts_map : std::vector<types::Se2>{}});
}

types::Result<std::unique_ptr<Member>> make_member(const Site& site, const TeamSetup& team,
                                                   std::uint16_t robot, RunHooks& hooks) {
  auto member = std::make_unique<Member>();
  member->setup = team.run;
  PlantSetup& plant_setup = member->setup.plant;
  plant_setup.T_building_map = site.starts.front();
  plant_setup.start = site.starts[robot];
  if (robot > 0) plant_setup.seed = sim::derive_seed(team.run.plant.seed, 100, robot);
  auto plant = plant_at(site, plant_setup);
  if (!plant) return tl::unexpected(plant.error());
  member->plant = std::move(*plant);
  std::vector<types::Se2> starts_map;
  for (const sim::Se2& start : site.starts) starts_map.push_back(site.starts.front().inverse() * start);
  if (!team.starts_known) member->T_common_map = starts_map[robot];
  auto source = source_of(*member, team, robot, starts_map);
  member->source = source.get();
  if (!team.starts_known) starts_map.clear();
  member->node =
      std::make_unique<TeamNode>(robot, *source, member->setup.mind.mapping, std::move(starts_map));
  member->mind = std::make_unique<RobotMind>(member->setup.mind, std::move(source));
  member->run =
      std::make_unique<RobotRun>(*member->plant, *member->mind, member->setup, hooks, member->node.get(),
                                 types::from_seconds(robot * team.entry_delay_s));
  return member;
}

}  // namespace

types::Result<TeamResult> run_team(const std::shared_ptr<sim::World>& world, const TeamSetup& setup,
                                   const sim::Raster& visible, std::span<RunHooks* const> hooks) {
  auto starts = sim::team_starts(*world, setup.run.plant.start, setup.robots);
  if (!starts) return tl::unexpected(starts.error());
  Site site{world, nullptr, std::move(*starts)};
  if (setup.run.fidelity == Fidelity::kFull) {
    const PlantSetup& plant = setup.run.plant;
    site.simulation = std::make_shared<sim::Simulation>(*world, plant.difficulty, plant.seed);
  }
  RunHooks nobody;
  std::vector<std::unique_ptr<Member>> members;
  for (std::uint16_t robot = 0; robot < setup.robots; ++robot) {
    RunHooks& own = robot < hooks.size() ? *hooks[robot] : nobody;
    auto member = make_member(site, setup, robot, own);
    if (!member) return tl::unexpected(member.error());
    members.push_back(std::move(*member));
  }
  return TeamRun(members, setup, visible).run();
}

}  // namespace topo::bench
