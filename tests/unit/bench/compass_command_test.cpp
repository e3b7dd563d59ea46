// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/compass/compass_command.hpp"

#include <gtest/gtest.h>

#include "core/types/se2.hpp"

namespace topo::bench {
namespace {

double error_deg(double angle_deg, double turned_deg, double turn_deg) {
  return turn_error_deg(angle_deg * types::kDegree_rad, turned_deg * types::kDegree_rad, turn_deg);
}

TEST(TurnError, IsModuloAQuarter) {
  EXPECT_NEAR(error_deg(3.0, 10.2, 7.0), 0.2, 1e-9);
  EXPECT_NEAR(error_deg(3.0, 9.8, 7.0), 0.2, 1e-9);
  EXPECT_NEAR(error_deg(80.0, 37.0, 47.0), 0.0, 1e-9);  // 127 is 37
  EXPECT_NEAR(error_deg(0.05, 88.9, 89.0), 0.15, 1e-9);
  EXPECT_NEAR(error_deg(0.0, 45.0, 0.0), 45.0, 1e-9);
}

TEST(TurnError, OfNoDirectionIsTheWorst) {
  EXPECT_EQ(turn_error_deg(std::nullopt, 0.1, 7.0), 45.0);
  EXPECT_EQ(turn_error_deg(0.1, std::nullopt, 7.0), 45.0);
}

TEST(NearestError, IsOfTheNearestAndTheWorstWithoutAny) {
  EXPECT_NEAR(nearest_error_deg({0.0, 30.2 * types::kDegree_rad}, 30.0 * types::kDegree_rad), 0.2, 1e-9);
  EXPECT_NEAR(nearest_error_deg({89.9 * types::kDegree_rad}, 0.0), 0.1, 1e-9);
  EXPECT_EQ(nearest_error_deg({}, 0.0), 45.0);
}

TEST(CompassCommand, NamesAMapThatIsNotThere) {
  CompassCommand command;
  command.maps = {"nowhere.yaml"};
  const auto refused = run_compass(command);
  ASSERT_FALSE(refused.has_value());
  EXPECT_NE(refused.error().message.find("nowhere.yaml"), std::string::npos);
}

}  // namespace
}  // namespace topo::bench
