// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/sim/team_start.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/sim/robot_model.hpp"

namespace topo::sim {
namespace {

// Centres: room to turn for both, and what a robot that is home may be beside its place.
constexpr double kApart_m = 1.3;
constexpr double kNearest_m = 1.3, kFarthest_m = 8.0, kRing_m = 0.25;
constexpr int kDirections = 24;
constexpr double kStep_m = 0.1;
constexpr double kSetOut_m = 0.15;

bool has_straight_way(const World& world, const RobotModel& model, const Se2& from, const Se2& to) {
  const types::Vector2 way = to.translation() - from.translation();
  const int steps = static_cast<int>(std::ceil(way.norm() / kStep_m));
  for (int i = 0; i <= steps; ++i) {
    const types::Vector2 p = from.translation() + way * (static_cast<double>(i) / std::max(steps, 1));
    const Se2 pose{p.x(), p.y(), std::atan2(way.y(), way.x())};
    if (world.touch(model.footprint(), pose, model.clearance_m, model.height_m).touching) return false;
  }
  return true;
}

/// Places around the spot: ring by ring, on each from behind the spot to before it, so that nobody stands in
/// the way of the first.
std::vector<Se2> places_around(const Se2& spot) {
  std::vector<Se2> places;
  for (double r = kNearest_m; r <= kFarthest_m; r += kRing_m) {
    for (int i = 0; i < kDirections; ++i) {
      const int away = (i + 1) / 2 * (i % 2 == 0 ? 1 : -1);  // 0, -1, 1, -2, 2, ...
      const double angle = std::numbers::pi + away * 2.0 * std::numbers::pi / kDirections;
      places.push_back(spot * Se2{r * std::cos(angle), r * std::sin(angle), 0.0});
    }
  }
  return places;
}

}  // namespace

bool has_room(const World& world, const Se2& pose) {
  const RobotModel model = RobotModel::p3dx();
  if (world.structure().at(pose.translation()) == 0) return false;
  for (int i = 0; i < 8; ++i) {
    const Se2 turned = pose * Se2{0.0, 0.0, i * std::numbers::pi / 4.0} * Se2{kSetOut_m, 0.0, 0.0};
    if (world.touch(model.footprint(), turned, model.clearance_m, model.height_m).touching) return false;
  }
  return true;
}

types::Result<std::vector<Se2>> team_starts(const World& world, const Se2& spot, int robots) {
  const RobotModel model = RobotModel::p3dx();
  std::vector<Se2> starts{spot};
  for (const Se2& place : places_around(spot)) {
    if (starts.size() >= static_cast<std::size_t>(robots)) break;
    const bool taken = std::any_of(starts.begin(), starts.end(), [&](const Se2& other) {
      return (other.translation() - place.translation()).norm() < kApart_m;
    });
    if (!taken && has_room(world, place) && has_straight_way(world, model, place, spot))
      starts.push_back(place);
  }
  if (starts.size() >= static_cast<std::size_t>(robots)) return starts;
  return types::fail(types::Errc::kInvalidInput,
                     fmt::format("world '{}': found room for {} robots within {} m of the start, expected {}",
                                 world.name(), starts.size(), kFarthest_m, robots));
}

}  // namespace topo::sim
