// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/exploration/look_behind.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numbers>

namespace topo::exploration {
namespace {

using types::Se2;
using types::Vector2;

/// Four by four metres around the origin: free where a robot there saw something, unknown elsewhere.
template <typename IsKnown>
grid::DenseMap map_where(const IsKnown& is_known) {
  grid::DenseMap map;
  map.box = {{-40, -40}, {39, 39}};
  map.cells.assign(80 * 80, grid::CellState::kUnknown);
  for (std::size_t i = 0; i < map.cells.size(); ++i)
    if (is_known(map.centre_of(map.cell(i)))) map.cells[i] = grid::CellState::kFree;
  return map;
}

/// What a UTM-30LX sees, and the disc that the robot covers.
grid::DenseMap first_look(double theta_rad) {
  return map_where([&](const Vector2& p) {
    const double bearing_rad = types::wrap_angle(std::atan2(p.y(), p.x()) - theta_rad);
    return p.norm() < 0.3 || std::abs(bearing_rad) < 0.75 * std::numbers::pi;
  });
}

RC_GTEST_PROP(LookBehind, ARobotThatHasJustBegunTurnsAbout, ()) {
  const double theta_rad = *rc::gen::inRange(-314, 314) / 100.0;
  const auto heading = heading_to_unseen(first_look(theta_rad), Se2{0.0, 0.0, theta_rad}, {});
  RC_ASSERT(heading.has_value());
  RC_ASSERT(std::abs(types::wrap_angle(*heading - theta_rad - std::numbers::pi)) < 0.15);
}

TEST(LookBehind, WhatIsKnownNeedsNoTurn) {
  EXPECT_FALSE(heading_to_unseen(map_where([](const Vector2&) { return true; }), Se2{0.0, 0.0, 0.0}, {}));
}

TEST(LookBehind, WhatTheScannerSeesNeedsNoTurn) {
  EXPECT_FALSE(
      heading_to_unseen(map_where([](const Vector2& p) { return p.x() < 0.5; }), Se2{0.0, 0.0, 0.0}, {}))
      << "unknown ahead";
}

TEST(LookBehind, AWallHidesWhatIsBehindIt) {
  grid::DenseMap map = first_look(0.0);
  for (std::int32_t y = -20; y < 20; ++y) map.cells[map.index({-4, y})] = grid::CellState::kOccupied;
  EXPECT_FALSE(heading_to_unseen(map, Se2{0.0, 0.0, 0.0}, {}));
}

}  // namespace
}  // namespace topo::exploration
