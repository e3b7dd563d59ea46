// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/sim/laser.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/unit/sim/rooms.hpp"

namespace topo::sim {
namespace {

using std::numbers::pi;

/// Long and straight, 40 m apart.
constexpr const char* kTwoWalls = R"(
[[start]]
x_m = 2.0
y_m = 2.0
[[wall]]
points_m = [[0.0, 0.0], [100.0, 0.0]]
[[wall]]
points_m = [[0.0, 40.0], [100.0, 40.0]]
)";

LaserSimulator::PoseAt standing(const Se2& pose) {
  return [pose](SimTime) { return pose; };
}

TEST(LaserModel, HasTheStepsAnglesAndTimesOfTheDataSheets) {
  const LaserModel utm = LaserModel::utm_30lx();
  EXPECT_EQ(utm.steps(), 1081);
  EXPECT_EQ(utm.period(), SimTime{25'000'000});
  EXPECT_NEAR(utm.angle_rad(0), -0.75 * pi, 1e-12);
  EXPECT_NEAR(utm.angle_rad(1080), 0.75 * pi, 1e-12);
  EXPECT_EQ(utm.step_time(1080), SimTime{18'750'000});
  const LaserModel urg = LaserModel::urg_04lx();
  EXPECT_EQ(urg.steps(), 682);
  EXPECT_EQ(urg.period(), SimTime{100'000'000});
  EXPECT_NEAR(urg.angle_rad(44) / types::kDegree_rad, -119.53, 0.005);
  EXPECT_NEAR(urg.angle_rad(725) / types::kDegree_rad, 119.88, 0.005);
}

TEST(Laser, MeasuresARoomFromItsMount) {
  const World world = scene(room_text());
  LaserSimulator laser(world, LaserModel::utm_30lx(), {0.5, 0.25, 0.3, 0.0, ScanPlane::kLevel},
                       Difficulty::none(), 1);
  // Facing +y: the mount's 0.5 m ahead are y, its 0.25 m to the left are -x.
  const Sweep sweep = laser.measure(SimTime{0}, 0, standing({4.0, 3.0, 0.5 * pi}));
  ASSERT_EQ(sweep.range_mm.size(), 1081U);
  EXPECT_EQ(sweep.range_mm[540], 2500U);        // ahead: 6.0 - 3.5
  EXPECT_EQ(sweep.range_mm[540 + 360], 3750U);  // left: 4.0 - 0.25
  EXPECT_EQ(sweep.range_mm[540 - 360], 4250U);  // right
  EXPECT_GT(sweep.intensity[540], 0);
  EXPECT_EQ(sweep.end, SimTime{18'750'000});
}

TEST(Laser, SaysWithCodesThatNothingCameBackOrTooNear) {
  const World world = scene(kTwoWalls);
  for (const LaserModel& model :
       {LaserModel::utm_30lx(), LaserModel::utm_30lx_ew(), LaserModel::ust_10lx(), LaserModel::urg_04lx()}) {
    LaserSimulator laser(world, model, {}, Difficulty::none(), 1);
    const Sweep away = laser.measure(SimTime{0}, 0, standing({50.0, 5.0, 0.5 * pi}));
    EXPECT_EQ(away.range_mm[static_cast<std::size_t>(model.step_front - model.step_min)],
              model.code_no_return)
        << model.name;
    EXPECT_EQ(away.intensity[static_cast<std::size_t>(model.step_front - model.step_min)], 0) << model.name;
    const Sweep close = laser.measure(SimTime{0}, 0, standing({50.0, 0.07, -0.5 * pi}));
    EXPECT_EQ(close.range_mm[static_cast<std::size_t>(model.step_front - model.step_min)],
              model.code_too_near)
        << model.name;
    EXPECT_TRUE(model.code_no_return < 20U ||
                model.code_no_return > static_cast<std::uint32_t>(model.distance_max_mm));
  }
}

TEST(Laser, ASweepIsNotAnInstant) {
  const World world = scene(room_text());
  LaserSimulator laser(world, LaserModel::utm_30lx(), {0.0, 0.0, 0.3, 0.0, ScanPlane::kLevel},
                       Difficulty::none(), 1);
  const double omega = 2.0;
  const auto turning = [omega](SimTime t) { return Se2{4.0, 3.0, omega * types::to_seconds(t)}; };
  const SimTime start{1'000'000'000};
  const Sweep sweep = laser.measure(start, 0, turning);
  const LaserModel& model = laser.model();
  double largest_error_mm = 0.0;
  for (int step = 0; step <= model.step_max; step += 9) {
    const double heading = omega * types::to_seconds(start + model.step_time(step));
    const double expected = world.level_range_m(4.0, 3.0, 0.3, heading + model.angle_rad(step));
    EXPECT_NEAR(sweep.range_mm[static_cast<std::size_t>(step)], 1e3 * expected, 0.51);
    const double frozen = world.level_range_m(4.0, 3.0, 0.3, 2.0 + model.angle_rad(step));
    largest_error_mm =
        std::max(largest_error_mm, std::abs(1e3 * frozen - sweep.range_mm[static_cast<std::size_t>(step)]));
  }
  EXPECT_GT(largest_error_mm,
            50.0);  // what a reader who thinks of an instant gets wrong: 2.1 degrees at the end
}

TEST(Laser, TheCoronalPlaneIsAcrossTheDrivingDirection) {
  const World world = scene(room_text());
  LaserSimulator laser(world, LaserModel::utm_30lx(), {0.1, 0.0, 0.4, 0.0, ScanPlane::kCoronal},
                       Difficulty::none(), 1);
  const Sweep sweep = laser.measure(SimTime{0}, 0, standing({3.0, 2.0, 0.0}));
  EXPECT_EQ(sweep.range_mm[540], 2100U);        // up: ceiling 2.5 - 0.4
  EXPECT_EQ(sweep.range_mm[540 + 360], 4000U);  // left: y from 2 to 6
  EXPECT_EQ(sweep.range_mm[540 - 360], 2000U);  // right: y from 2 to 0
  EXPECT_EQ(sweep.range_mm[1080],
            static_cast<std::uint32_t>(std::lround(400.0 * std::sqrt(2.0))));  // floor, 45 degrees down
  // Turned to +y, left is -x.
  const Sweep turned = laser.measure(SimTime{0}, 0, standing({3.0, 2.0, 0.5 * pi}));
  EXPECT_EQ(turned.range_mm[540 + 360], 3000U);
  EXPECT_EQ(turned.range_mm[540 - 360], 5000U);
}

struct Statistics {
  double mean_mm = 0.0, sigma_mm = 0.0;
  int count = 0;
};

// Errors of beams whose true range lies between two bounds; the room is one long straight wall.
Statistics noise(double low_m, double high_m, int& dropouts, int& beams) {
  const World world = scene(kTwoWalls);
  LaserSimulator clean(world, LaserModel::utm_30lx(), {}, Difficulty::none(), 1);
  LaserSimulator noisy(world, LaserModel::utm_30lx(), {}, Difficulty{}, 1);
  const auto pose = standing({50.0, 6.0, -0.5 * pi});
  const Sweep truth = clean.measure(SimTime{0}, 0, pose);
  double sum = 0.0, squares = 0.0;
  Statistics s;
  dropouts = beams = 0;
  for (std::uint64_t number = 0; number < 200; ++number) {
    const Sweep sweep = noisy.measure(SimTime{0}, number, pose);
    for (std::size_t i = 0; i < sweep.range_mm.size(); ++i) {
      const double true_mm = truth.range_mm[i];
      if (true_mm < 1e3 * low_m || true_mm > 1e3 * high_m) continue;
      ++beams;
      if (sweep.range_mm[i] < 23) {
        ++dropouts;
        continue;
      }
      const double error = sweep.range_mm[i] - true_mm;
      if (std::abs(error) > 250.0) continue;  // mixed pixels where neighbours are far apart
      sum += error;
      squares += error * error;
      ++s.count;
    }
  }
  s.mean_mm = sum / s.count;
  s.sigma_mm = std::sqrt(squares / s.count - s.mean_mm * s.mean_mm);
  return s;
}

TEST(Laser, NoiseIsAsTheDifficultySays) {
  int dropouts = 0;
  int beams = 0;
  const Statistics near = noise(6.0, 9.9, dropouts, beams);
  ASSERT_GT(near.count, 50000);
  EXPECT_NEAR(near.mean_mm, 0.0, 0.5);
  EXPECT_NEAR(near.sigma_mm, 30.0, 0.5);
  EXPECT_NEAR(static_cast<double>(dropouts) / beams, 0.010, 0.0015);
  const Statistics far = noise(10.1, 14.0, dropouts, beams);
  ASSERT_GT(far.count, 5000);
  EXPECT_NEAR(far.mean_mm, 0.0, 3.0);
  EXPECT_NEAR(far.sigma_mm, 50.0, 2.0);
}

TEST(Laser, MixesPixelsAtThirtyPerCentOfTheDepthEdges) {
  const World world = scene(room_text() + R"([[box]]
center_m = [6.0, 3.0]
length_m = 0.2
width_m = 1.0
z_max_m = 1.0
)");
  Difficulty only_mixing = Difficulty::none();
  only_mixing.mixed_pixel_probability = Difficulty{}.mixed_pixel_probability;
  LaserSimulator laser(world, LaserModel::utm_30lx(), {}, only_mixing, 1);
  LaserSimulator clean(world, LaserModel::utm_30lx(), {}, Difficulty::none(), 1);
  const auto pose = standing({2.0, 3.0, 0.0});
  const Sweep truth = clean.measure(SimTime{0}, 0, pose);
  int edges = 0;
  for (std::size_t i = 1; i < truth.range_mm.size(); ++i) {
    edges += std::abs(double(truth.range_mm[i]) - double(truth.range_mm[i - 1])) > 300.0 ? 1 : 0;
  }
  ASSERT_EQ(edges, 2);
  constexpr int kSweeps = 1500;
  int mixed = 0;
  for (std::uint64_t n = 0; n < kSweeps; ++n) {
    const Sweep sweep = laser.measure(SimTime{0}, n, pose);
    for (std::size_t i = 0; i < truth.range_mm.size(); ++i) {
      if (sweep.range_mm[i] == truth.range_mm[i]) continue;
      ++mixed;
      EXPECT_GT(sweep.range_mm[i], 3800U);  // between the box and the wall behind it
      EXPECT_LT(sweep.range_mm[i], 6200U);
    }
  }
  EXPECT_NEAR(mixed / (2.0 * kSweeps), 0.30, 0.03);
}

TEST(Laser, TheSameSeedGivesTheSameSweepInAnyOrder) {
  const World world = scene(room_text());
  LaserSimulator a(world, LaserModel::utm_30lx(), {}, Difficulty{}, 42);
  LaserSimulator b(world, LaserModel::utm_30lx(), {}, Difficulty{}, 42);
  LaserSimulator c(world, LaserModel::utm_30lx(), {}, Difficulty{}, 43);
  const auto pose = standing({2.0, 3.0, 0.0});
  (void)b.measure(SimTime{0}, 8, pose);
  const Sweep of_a = a.measure(SimTime{0}, 9, pose);
  EXPECT_EQ(of_a.range_mm, b.measure(SimTime{0}, 9, pose).range_mm);
  EXPECT_NE(of_a.range_mm, c.measure(SimTime{0}, 9, pose).range_mm);
}

}  // namespace
}  // namespace topo::sim
