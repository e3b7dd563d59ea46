// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/bound/bound_command.hpp"

#include <fmt/format.h>

#include <cmath>

#include "tests/bench/topobench/bound/bound.hpp"
#include "tests/bench/topobench/explore/explore_run.hpp"
#include "tests/bench/topobench/overview.hpp"
#include "tests/sim/area.hpp"
#include "tests/sim/robot_model.hpp"
#include "tests/sim/team_start.hpp"

namespace topo::bench {
namespace {

using nlohmann::json;
using types::Errc;
using types::fail;

constexpr int kBoundRobotsMax = 8;

json centimetres(double value) {
  return std::isfinite(value) ? json(std::round(1e2 * value) / 1e2) : json(nullptr);
}

types::Status check(const BoundCommand& command) {
  if (command.robots < 1 || command.robots > kBoundRobotsMax)
    return fail(Errc::kInvalidInput,
                fmt::format("--robots: found {}, expected 1 to {}", command.robots, kBoundRobotsMax));
  if (!command.start.empty() && command.start.size() != 3)
    return fail(Errc::kInvalidInput, "--start: expected X,Y,THETA in metres and radians");
  return {};
}

types::Status save_picture(const BoundCommand& command, const sim::World& world,
                           const sim::ReachableArea& area, const bound::Bound& found) {
  if (command.picture.empty()) return {};
  std::vector<std::vector<sim::Se2>> ways;
  for (const bound::Way& way : found.ways) {
    ways.emplace_back();
    for (const sim::Vector2& p : way) ways.back().push_back({p.x(), p.y(), 0.0});
  }
  const std::vector<std::vector<sim::Se2>> mates(ways.begin() + 1, ways.end());
  const sim::Raster none(area.visible.resolution_m, area.visible.origin, area.visible.width,
                         area.visible.height);
  return overview(world, {area.visible, none, ways.front(), {}, mates}).save_png(command.picture);
}

}  // namespace

types::Result<json> bound_report(const BoundCommand& command) {
  if (auto status = check(command); !status) return tl::unexpected(status.error());
  const auto world = sim::World::load(command.world);
  if (!world) return tl::unexpected(world.error());
  const auto& s = command.start;
  const sim::Se2 start = s.empty() ? world->start_poses().front() : sim::Se2{s[0], s[1], s[2]};
  const auto starts = sim::team_starts(*world, start, command.robots);
  if (!starts) return tl::unexpected(starts.error());
  const sim::ReachableArea area =
      reachable_area(*world, start.translation(), sim::RobotModel::p3dx().swing_radius_m);
  bound::BoundInput input{
      &*world, &area.poses, &area.visible, {}, default_setup(start, 1, Fidelity::kPlan).mind.control.limits};
  for (const sim::Se2& pose : *starts) input.starts.push_back(pose.translation());
  const bound::Bound found = bound::find_bound(input, {});
  json way = json::object(), full = json::object(), own = json::object(), lower = json::object(),
       lower_s = json::object();
  for (std::size_t i = 0; i < bound::kBoundShares.size(); ++i) {
    const std::string name = fmt::format("{:g}", bound::kBoundShares[i]);
    const bound::ShareBound& share = found.shares[i];
    way[name] = centimetres(share.way_m);
    full[name] = centimetres(share.full_speed_s);
    own[name] = centimetres(share.own_motion_s);
    lower[name] = centimetres(share.lower_m);
    lower_s[name] = centimetres(share.lower_s);
  }
  if (auto saved = save_picture(command, *world, area, found); !saved) return tl::unexpected(saved.error());
  return json{{"world", command.world.stem().string()},
              {"robots", command.robots},
              {"start", {start.x_m, start.y_m}},
              {"reachable_m2", centimetres(area.visible.area_m2())},
              {"m_per_robot", way},
              {"seconds_at_full_speed", full},
              {"seconds_at_own_motion", own},
              {"lower_m_per_robot", lower},
              {"lower_seconds_at_full_speed", lower_s},
              {"feasible", found.is_feasible}};
}

types::Status run_bound(const BoundCommand& command) {
  const auto report = bound_report(command);
  if (!report) return tl::unexpected(report.error());
  fmt::print("{}\n", command.json ? report->dump() : report->dump(2));
  return {};
}

}  // namespace topo::bench
