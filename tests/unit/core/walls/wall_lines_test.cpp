// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/walls/wall_lines.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <tuple>

#include "tests/unit/core/walls/points.hpp"

namespace topo::walls {
namespace {

std::vector<Place> row_of_places(int count, float step_m) {
  std::vector<Place> places;
  for (int i = 0; i < count; ++i) places.push_back({3.0F + step_m * static_cast<float>(i), 1.0F});
  return places;
}

TEST(IsWallRun, NeedsPointsLengthAndFewGaps) {
  WallParams params;
  params.points_min = 8;
  params.length_min_m = 1.0;
  params.filled_min = 0.35;
  EXPECT_TRUE(is_wall_run(row_of_places(21, 0.05F), params)) << "a metre";
  EXPECT_FALSE(is_wall_run(row_of_places(20, 0.05F), params)) << "0.95 m";
  EXPECT_TRUE(is_wall_run(row_of_places(8, 0.15F), params));
  EXPECT_FALSE(is_wall_run(row_of_places(7, 0.18F), params)) << "too few points";
  EXPECT_FALSE(is_wall_run(row_of_places(8, 0.4F), params)) << "one bin of four";
  EXPECT_FALSE(is_wall_run(row_of_places(100, 0.0F), params)) << "a post";
  EXPECT_FALSE(is_wall_run({}, params));
  params.points_min = 0;
  params.length_min_m = params.filled_min = 0.0;
  EXPECT_FALSE(is_wall_run(row_of_places(1, 0.0F), params)) << "one point has no direction";
  EXPECT_TRUE(is_wall_run(row_of_places(2, 0.1F), params));
}

TEST(IsWallRun, MorePointsBetweenTheEndsKeepAWall) {
  EXPECT_TRUE(rc::check([] {
    std::vector<Place> places = row_of_places(*rc::gen::inRange(2, 30), 0.13F);
    const WallParams params;
    const bool was = is_wall_run(places, params);
    const float last = places.back().u;
    for (int more = *rc::gen::inRange(0, 30); more > 0; --more)
      places.push_back({3.0F + (last - 3.0F) * static_cast<float>(*rc::gen::inRange(0, 101)) * 0.01F, 1.0F});
    std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) { return a.u < b.u; });
    if (was) RC_ASSERT(is_wall_run(places, params));
  }));
}

std::vector<std::tuple<float, float>> sorted_places(std::span<const Place> places) {
  std::vector<std::tuple<float, float>> out;
  for (const Place& p : places) out.emplace_back(p.u, p.v);
  std::sort(out.begin(), out.end());
  return out;
}

/// A part of a building at some angle, in any order.
Points any_part(const Points& plan) {
  Points points = plan;
  const double from_m = *rc::gen::inRange(0, 28), wide_m = *rc::gen::inRange(0, 12);
  std::erase_if(points, [&](const auto& p) { return p.x() > from_m && p.x() < from_m + wide_m; });
  if (*rc::gen::arbitrary<bool>()) std::reverse(points.begin(), points.end());
  if (points.empty()) points.emplace_back(1.0, 2.0);
  return points;
}

Direction any_direction() {
  const double angle_rad = *rc::gen::inRange(0, 180) * types::kDegree_rad;
  return {std::cos(angle_rad), std::sin(angle_rad)};
}

TEST(WallLines, BinsHoldEachPointOnceInTheirOrder) {
  EXPECT_TRUE(rc::check([] {
    Points points = any_part(cell_centres(building()));
    const Direction direction = any_direction();
    const WallLines lines(points, direction, {});
    std::vector<Place> places;
    float below = -HUGE_VALF;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const auto bin = lines.bin(i);
      const auto sorted = sorted_places(bin);
      for (std::size_t k = 0; k < bin.size(); ++k) RC_ASSERT(sorted[k] == std::tuple(bin[k].u, bin[k].v));
      float above = -HUGE_VALF;
      for (const Place& p : bin) {
        RC_ASSERT(p.v >= below - 1e-4F);
        above = std::max(above, p.v);
      }
      if (!bin.empty()) below = above;
      places.insert(places.end(), bin.begin(), bin.end());
    }
    std::vector<Place> expected;
    for (const types::Vector2& p : points)
      expected.push_back(
          {static_cast<float>(direction.along_m(p)), static_cast<float>(direction.across_m(p))});
    RC_ASSERT(sorted_places(places) == sorted_places(expected));
  }));
}

/// The stretches of one line by the definition: its points in order, parted at the gaps.
std::vector<std::vector<std::tuple<float, float>>> stretches_of_line(const WallLines& lines, std::size_t line,
                                                                     const WallParams& params) {
  std::vector<Place> places(lines.bin(line).begin(), lines.bin(line).end());
  places.insert(places.end(), lines.bin(line + 1).begin(), lines.bin(line + 1).end());
  std::sort(places.begin(), places.end(),
            [](const Place& a, const Place& b) { return std::tie(a.u, a.v) < std::tie(b.u, b.v); });
  std::vector<std::vector<std::tuple<float, float>>> out;
  std::vector<Place> run;
  const auto end_run = [&] {
    if (is_wall_run(run, params)) out.push_back(sorted_places(run));
    run.clear();
  };
  for (const Place& p : places) {
    if (!run.empty() && p.u - run.back().u > static_cast<float>(params.gap_max_m)) end_run();
    run.push_back(p);
  }
  end_run();
  return out;
}

TEST(WallLines, StretchesAreTheRunsOfTwoBinsThatMayBeWalls) {
  EXPECT_TRUE(rc::check([] {
    Points points = any_part(cell_centres(building()));
    WallParams params;
    params.gap_max_m = *rc::gen::element(0.06, 0.2, 0.45);
    params.points_min = *rc::gen::element(0, 8, 20);
    const WallLines lines(points, any_direction(), params);
    auto next = lines.stretches().begin();
    for (std::size_t line = 0; line < lines.size(); ++line) {
      for (const auto& expected : stretches_of_line(lines, line, params)) {
        RC_ASSERT(next != lines.stretches().end());
        RC_ASSERT(next->line == line);
        RC_ASSERT(sorted_places(lines.places_of(*next)) == expected);
        ++next;
      }
    }
    RC_ASSERT(next == lines.stretches().end());
  }));
}

TEST(WallLines, AFewFarPointsNeedNoMoreBinsThanThereMayBe) {
  const Points points{{0.0, 0.0}, {0.0, 1e7}, {0.0, -1e7}};
  const WallLines lines(points, {1.0, 0.0}, {});
  EXPECT_LE(lines.size(), 1000U + 8U * points.size() + 1U);
  EXPECT_EQ(lines.bin(0).size(), 1U);
  EXPECT_EQ(lines.bin(lines.size() - 1).size(), 1U);
}

}  // namespace
}  // namespace topo::walls
