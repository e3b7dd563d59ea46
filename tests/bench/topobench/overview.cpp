// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/overview.hpp"

#include <array>

namespace topo::bench {
namespace {

constexpr double kScale_m = 0.025;  // a pixel
constexpr sim::Colour kUnseen{240, 170, 170};
constexpr sim::Colour kSeen{170, 225, 170};
constexpr sim::Colour kGoal{230, 120, 0};
constexpr std::array<sim::Colour, 3> kMates{{{200, 0, 160}, {0, 130, 60}, {130, 90, 0}}};

}  // namespace

sim::Picture overview(const sim::World& world, const OverviewParts& parts) {
  sim::Picture picture(world.extents(), kScale_m);
  sim::Raster unseen = parts.visible;
  for (std::size_t i = 0; i < unseen.cells.size(); ++i) {
    if (parts.covered.cells[i] != 0) unseen.cells[i] = 0;
  }
  picture.tint(unseen, kUnseen);
  picture.tint(parts.covered, kSeen);
  picture.world(world);
  for (std::size_t i = 0; i < parts.mates.size(); ++i)
    picture.path(parts.mates[i], kMates[i % kMates.size()]);
  picture.path(parts.path, sim::kTruthInk);
  if (parts.path.empty()) return picture;
  const types::Vector2 start = parts.path.front().translation();
  types::Vector2 before = start;
  for (const types::Vector2& goal : parts.goals) {
    picture.line(before, goal, kGoal);
    picture.dot(goal, kGoal, 5);
    before = goal;
  }
  picture.dot(start, sim::kScanInk, 8);
  return picture;
}

}  // namespace topo::bench
