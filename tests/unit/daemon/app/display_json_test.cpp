// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/app/display_json.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <vector>

namespace topo::daemon {
namespace {

types::Scan scan_of(std::size_t beams, float range_m) {
  types::Scan scan;
  scan.geometry.angle_increment_rad = static_cast<float>(std::numbers::pi / 2.0);
  scan.beams = static_cast<std::uint16_t>(beams);
  std::fill_n(scan.range_m.begin(), beams, range_m);
  return scan;
}

TEST(ScanJson, IsWhereTheRaysEndInTheMap) {
  types::Scan scan = scan_of(4, 2.0F);
  scan.range_m[2] = types::kNoReturn;
  const Json json = scan_json(scan, {10.0, 0.5, std::numbers::pi / 2.0});
  EXPECT_EQ(json, (Json{{"cm", {1000, 250, 800, 50, 1200, 50}}}));
}

TEST(ScanJson, OfManyBeamsSome) {
  for (const std::size_t beams :
       {std::size_t{0}, std::size_t{1}, std::size_t{120}, std::size_t{1081}, types::Scan::kMaxBeams}) {
    const std::size_t points = scan_json(scan_of(beams, 1.0F), {})["cm"].size() / 2;
    EXPECT_LE(points, 90U);
    EXPECT_GE(points, std::min<std::size_t>(beams, 45));
  }
}

TEST(TrailJson, EndsWhereTheWayEnds) {
  std::vector<types::Vector2> way;
  EXPECT_TRUE(trail_json(way).empty());
  for (int i = 0; i < 1000; ++i) way.emplace_back(0.111 * i, 1.0);
  const Json trail = trail_json(way);
  EXPECT_LE(trail.size(), 302U);
  EXPECT_EQ(trail.front(), Json::parse("[0.0, 1.0]"));
  EXPECT_EQ(trail.back(), Json::parse("[110.89, 1.0]"));
}

}  // namespace
}  // namespace topo::daemon
