// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "tests/unit/core/pipeline/toy_building.hpp"

namespace topo::pipeline {
namespace {

using types::Vector2;

constexpr std::size_t kWing = 44, kHall = 40;  // characters of 0.25 m

std::string row(char wing, const std::string& hall) {
  return "#" + std::string(kWing, wing) + hall + std::string(kWing, wing) + "#";
}

/// A hall of 10 m by 6.5 m with pillars and niches, in which a robot sees gaps everywhere, and a corridor of
/// 11 m from either side. `start`: column of the hall where a robot enters.
std::vector<std::string> entrance(std::size_t start) {
  const std::string closed = "#" + std::string(kHall - 2, ' ') + "#";
  const std::string open(kHall, ' ');
  std::string niches = closed, pillars = open, shelves = closed, door = closed;
  for (std::size_t x = 5; x < kHall - 5; x += 8) niches.replace(x, 3, "###");
  for (std::size_t x = 8; x < kHall - 8; x += 6) pillars.replace(x, 2, "##");
  shelves.replace(10, 6, "######").replace(26, 6, "######");
  door[start] = 'S';
  std::vector<std::string> rows{row('#', std::string(kHall, '#'))};
  const auto add = [&](std::size_t times, char wing, const std::string& hall) {
    for (std::size_t i = 0; i < times; ++i) rows.push_back(row(wing, hall));
  };
  add(3, '#', niches);
  add(4, '#', closed);
  add(3, ' ', open);
  add(2, ' ', pillars);
  add(3, ' ', open);
  add(2, '#', closed);
  add(2, '#', shelves);
  add(4, '#', closed);
  add(1, '#', door);
  add(2, '#', closed);
  rows.push_back(row('#', std::string(kHall, '#')));
  return rows;
}

bool is_in_hall(const Vector2& p) {
  return p.x() > 0.25 * static_cast<double>(kWing + 1) &&
         p.x() < 0.25 * static_cast<double>(kWing + kHall + 1);
}

/// A robot of two, with the messages that it hears.
struct Entrant {
  Entrant(std::uint16_t id, std::size_t column) : building(entrance(column), 8.0) {
    heard.robot = id;
    building.hear(&heard);
  }
  void run_period() {
    out = building.run_period(state, {1, Order::kExplore, false, {0.0, 0.0}});
    left = left || !is_in_hall(building.robot());
  }

  ToyBuilding building;
  PlanningState state{PlannerParams{}};
  TeamInput heard;
  PlanningOutput out;
  bool left = false;
};

TEST(EntranceHall, isLeftByBothBeforeTheyHaveDriven45m) {
  Entrant one(1, 19), other(2, 23);
  std::array<team::StatusMessage, 2> said;
  double driven_m = 0.0;
  for (int period = 0; period < 400 && !(one.left && other.left); ++period) {
    one.run_period();
    other.run_period();
    said = {one.out.message, other.out.message};
    one.heard.messages = {&said[1], 1};
    other.heard.messages = {&said[0], 1};
    driven_m = one.building.path_m() + other.building.path_m();
  }
  EXPECT_TRUE(one.left && other.left);
  EXPECT_LT(driven_m, 45.0);
  const double middle_m = 0.25 * static_cast<double>(kWing + kHall / 2 + 1);
  EXPECT_LT((one.building.robot().x() - middle_m) * (other.building.robot().x() - middle_m), 0.0)
      << "they part: one to either side";
}

}  // namespace
}  // namespace topo::pipeline
