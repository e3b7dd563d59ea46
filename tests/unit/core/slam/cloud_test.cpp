// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/cloud.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <vector>

#include "tests/mocks/flat_world.hpp"
#include "tests/unit/core/slam/matching_fixture.hpp"

namespace topo::slam {
namespace {

using testing::View;

const CloudParams kCloudParams;

TEST(MakeCloud, LeavesOutWhatIsNoDistance) {
  types::Scan scan;
  scan.beams = 6;
  scan.geometry = {0.0F, 0.1F, 0.0F, 0.0F, 0.1F, 10.0F};
  scan.range_m[0] = 1.0F;
  scan.range_m[1] = types::kNoReturn;
  scan.range_m[2] = types::kTooNear;
  scan.range_m[3] = types::kInvalid;
  scan.range_m[4] = 10.0F;  // the range's end is no measurement
  scan.range_m[5] = 0.05F;  // below the minimum
  Cloud cloud;
  make_cloud(scan, {0.2, 0.0, 0.0}, {}, kCloudParams, cloud);
  ASSERT_EQ(cloud.points.size(), 1U);
  EXPECT_NEAR(cloud.points[0].x(), 1.2, 1e-6);
  EXPECT_NEAR(cloud.sensor.x(), 0.2, 1e-6);
  EXPECT_NEAR(cloud.invalid_share, 1.0 / 6.0, 1e-12) << "the others tell something";
  scan.beams = 0;
  EXPECT_EQ(invalid_share(scan), 0.0);
}

/// What is left of a sweep of 0.25 degrees from beam to beam.
std::vector<Point> hits_of(std::initializer_list<float> range_m) {
  types::Scan scan;
  scan.beams = static_cast<std::uint16_t>(range_m.size());
  scan.geometry = {0.0F, 0.0044F, 0.0F, 0.0F, 0.1F, 30.0F};
  std::copy(range_m.begin(), range_m.end(), scan.range_m.begin());
  Cloud cloud;
  make_cloud(scan, {}, {}, kCloudParams, cloud);
  return cloud.points;
}

TEST(MakeCloud, LeavesOutALoneReadingBetweenTwoSurfaces) {
  for (const float between : {2.2F, 3.0F, 3.8F}) {
    const auto hits = hits_of({2.0F, 2.01F, between, 4.0F, 4.02F});
    ASSERT_EQ(hits.size(), 4U) << between;
    for (const Point& p : hits) EXPECT_GT(std::abs(p.norm() - between), 0.1F);
    EXPECT_EQ(hits_of({4.02F, 4.0F, between, 2.01F, 2.0F}).size(), 4U) << "on the other side of it";
  }
}

TEST(MakeCloud, KeepsWhatIsNoMixedPixel) {
  EXPECT_EQ(hits_of({4.0F, 4.0F, 2.0F, 4.0F, 4.0F}).size(), 5U) << "a pole";
  EXPECT_EQ(hits_of({2.0F, 2.0F, 2.08F, 4.0F, 4.0F}).size(), 5U) << "noise at an edge";
  EXPECT_EQ(hits_of({2.0F, 2.2F, 2.43F, 2.7F, 3.0F}).size(), 5U) << "a wall at a grazing angle";
  EXPECT_EQ(hits_of({2.0F, 2.0F, 3.0F, 3.0F, 4.0F, 4.0F}).size(), 6U) << "a step that two beams saw";
  EXPECT_EQ(hits_of({2.0F, 3.0F, 4.0F}).size(), 3U)
      << "at the sweep's ends nothing is known of what is beside";
  for (const float none : {types::kNoReturn, types::kTooNear, types::kInvalid}) {
    EXPECT_EQ(hits_of({none, 2.0F, 3.0F, 4.0F, 4.0F}).size(), 4U) << "no surface before it";
    EXPECT_EQ(hits_of({2.0F, 2.0F, 3.0F, none, none}).size(), 3U) << "nor behind";
    EXPECT_EQ(hits_of({2.0F, 2.0F, 3.0F, none, 4.0F}).size(), 4U);
  }
}

/// A robot that drives and turns while the mirror sweeps sees a straight wall bent; the cloud must be
/// straight.
TEST(MakeCloud, UnbendsTheSweep) {
  mocks::FlatWorld world;
  world.walls.push_back({{-20.0, 3.0}, {20.0, 3.0}});
  const types::Se2 first{0.0, 0.0, 0.0}, last{0.04, 0.0, 0.05};  // 1.6 m/s and 2 rad/s over 25 ms
  types::Scan scan;
  scan.beams = 541;
  scan.geometry = {0.5F, 0.004F, 0.0F, 0.0F, 0.1F, 30.0F};
  for (std::size_t i = 0; i < scan.beams; ++i) {
    const types::Se2 at = types::interpolate(first, last, static_cast<double>(i) / (scan.beams - 1.0));
    const double r = world.range(at.x_m, at.y_m, at.theta_rad + static_cast<double>(scan.angle_rad(i)));
    scan.range_m[i] = r < 30.0 ? static_cast<float>(r) : types::kNoReturn;
  }
  Cloud cloud;
  make_cloud(scan, {}, {last.inverse() * first, {}}, kCloudParams, cloud);
  ASSERT_GT(cloud.points.size(), 400U);
  for (const Point& p : cloud.points) {
    const types::Vector2 world_point = last * types::Vector2(p.cast<double>());
    EXPECT_NEAR(world_point.y(), 3.0, 2e-3);
  }
}

TEST(SelectPoints, KeepsTheSweepAndTheLimit) {
  mocks::FlatWorld world;
  for (int k = 0; k < 720; ++k) {  // a round room of 5 m
    const double a = 0.0087266 * k, b = 0.0087266 * (k + 1);
    world.walls.push_back({{5.0 * std::cos(a), 5.0 * std::sin(a)}, {5.0 * std::cos(b), 5.0 * std::sin(b)}});
  }
  std::mt19937 random(1);
  Cloud cloud;
  make_cloud(mocks::take_scan(world, {}, {}, {1081, 4.7, 30.0, 0.0}, random), {}, {}, kCloudParams, cloud);
  std::vector<Point> points;
  select_points(cloud, kCloudParams, points);
  // Beams are 0.0218 m apart on the wall: every second one makes up 0.04 m.
  EXPECT_NEAR(static_cast<double>(points.size()), 1081.0 / 2.0,
              2.0 + (1081.0 / 2.0 - kCloudParams.match_points_max));
  EXPECT_LE(points.size(), static_cast<std::size_t>(kCloudParams.match_points_max));
  CloudParams few = kCloudParams;
  few.match_points_max = 50;
  select_points(cloud, few, points);
  EXPECT_EQ(points.size(), 50U);
}

/// A wall seen aslant, 1 m to the right.
View slanted_view(std::mt19937& random, double sigma_m) {
  mocks::FlatWorld world;
  world.walls.push_back({{1.0, -1.0}, {4.0, -1.0}});
  View view;
  make_cloud(mocks::take_scan(world, {}, {}, {1081, 4.7, 30.0, sigma_m}, random), {}, {}, kCloudParams,
             view.cloud);
  select_points(view.cloud, kCloudParams, view.points);
  view.surfels = make_surfels(view.cloud, kCloudParams);
  return view;
}

/// Which points are chosen must not depend on their noise: else a wall moves.
TEST(SelectPoints, DoesNotPreferNoise) {
  std::mt19937 random(5);
  double chosen = 0.0, all = 0.0;
  std::size_t chosen_count = 0, all_count = 0;
  for (int k = 0; k < 200; ++k) {
    const View view = slanted_view(random, 0.03);
    for (const Point& p : view.points) chosen += static_cast<double>(p.y()) + 1.0, ++chosen_count;
    for (const Point& p : view.cloud.points) all += static_cast<double>(p.y()) + 1.0, ++all_count;
  }
  ASSERT_GT(chosen_count, 5000U);
  EXPECT_NEAR(chosen / static_cast<double>(chosen_count), 0.0, 1e-3);
  EXPECT_NEAR(all / static_cast<double>(all_count), 0.0, 1e-3);
}

/// Noise along the beam turns a plain line fit by 0.029 rad here; more than half of that must be gone.
TEST(MakeSurfels, NoiseAlongTheBeamDoesNotTurnTheNormals) {
  std::mt19937 random(6);
  double turn = 0.0;
  int count = 0;
  for (int k = 0; k < 200; ++k) {
    for (const Surfel& s : slanted_view(random, 0.03).surfels) {
      if (!s.planar || s.position.x() < 1.4F || s.position.x() > 3.0F) continue;
      turn += std::asin(std::clamp(static_cast<double>(s.normal.x()), -1.0, 1.0));
      ++count;
    }
  }
  ASSERT_GT(count, 2000);
  EXPECT_NEAR(turn / count, 0.0, 0.014);
}

TEST(MakeSurfels, NormalsStandOnTheWallAndFaceTheSensor) {
  mocks::FlatWorld world;
  world.box(-4.0, -2.0, 4.0, 3.0);
  std::mt19937 random(2);
  Cloud cloud;
  make_cloud(mocks::take_scan(world, {}, {}, {1081, 4.7, 30.0, 0.01}, random), {}, {}, kCloudParams, cloud);
  const std::vector<Surfel> surfels = make_surfels(cloud, kCloudParams);
  ASSERT_GT(surfels.size(), 100U);
  int planar = 0, off = 0;
  for (const Surfel& s : surfels) {
    EXPECT_GE(s.normal.dot(-s.position), 0.0F);
    if (!s.planar) continue;
    ++planar;
    const float along = std::max(std::abs(s.normal.x()), std::abs(s.normal.y()));
    if (along < 0.97F) ++off;  // at the four corners the fit goes round the corner
  }
  EXPECT_GT(planar, static_cast<int>(surfels.size()) * 9 / 10);
  EXPECT_LT(off, static_cast<int>(surfels.size()) / 10);
}

TEST(MakeSurfels, AveragesTheNoiseAcrossTheSurface) {
  mocks::FlatWorld world;
  world.walls.push_back({{2.0, -5.0}, {2.0, 5.0}});
  std::mt19937 random(3);
  Cloud cloud;
  make_cloud(mocks::take_scan(world, {}, {}, {1081, 4.7, 30.0, 0.03}, random), {}, {}, kCloudParams, cloud);
  double raw = 0.0, fitted = 0.0;
  int count = 0;
  for (const Point& p : cloud.points) {
    if (std::abs(p.y()) < 1.0F) raw += std::pow(static_cast<double>(p.x()) - 2.0, 2), ++count;
  }
  raw /= count;
  count = 0;
  for (const Surfel& s : make_surfels(cloud, kCloudParams)) {
    if (std::abs(s.position.y()) < 1.0F)
      fitted += std::pow(static_cast<double>(s.position.x()) - 2.0, 2), ++count;
  }
  ASSERT_GT(count, 10);
  EXPECT_LT(fitted / count, 0.25 * raw);  // at least half the standard deviation
}

types::Scan room_scan(double sigma_m) {
  std::mt19937 random(11);
  return mocks::take_scan(mocks::two_rooms(), {3.0, 3.0, 0.2}, {}, {1081, 4.7, 30.0, sigma_m}, random);
}

Cloud cloud_of(const types::Scan& scan, const types::Se2& T_base_laser, const SweepMotion& motion = {}) {
  Cloud cloud;
  make_cloud(scan, T_base_laser, motion, kCloudParams, cloud);
  return cloud;
}

TEST(MakeCloud, MovesWithTheLaserAndWithTheRobot) {
  const types::Scan scan = room_scan(0.01);
  const Cloud at_base = cloud_of(scan, {});
  const types::Se2 mount{0.3, -0.1, 2.5};
  const Cloud mounted = cloud_of(scan, mount), carried = cloud_of(scan, {}, {mount, mount});
  ASSERT_EQ(mounted.points.size(), at_base.points.size());
  ASSERT_EQ(carried.points.size(), at_base.points.size());
  EXPECT_EQ(mounted.spacing_m, at_base.spacing_m);
  for (std::size_t i = 0; i < at_base.points.size(); ++i) {
    const Point expected = (mount * types::Vector2(at_base.points[i].cast<double>())).cast<float>();
    EXPECT_LT((mounted.points[i] - expected).norm(), 1e-5F);
    EXPECT_LT((carried.points[i] - expected).norm(), 1e-5F);
  }
  EXPECT_LT((mounted.sensor - Point(0.3F, -0.1F)).norm(), 1e-6F);
}

TEST(MakeCloud, IntoUsedMemoryIsAsIntoNew) {
  Cloud cloud = cloud_of(room_scan(0.01), {0.1, 0.0, 0.0});
  types::Scan few = room_scan(0.02);
  few.beams = 200;
  make_cloud(few, {}, {}, kCloudParams, cloud);
  const Cloud fresh = cloud_of(few, {});
  EXPECT_EQ(cloud.points, fresh.points);
  EXPECT_EQ(cloud.spacing_m, fresh.spacing_m);
  EXPECT_EQ(cloud.sensor, fresh.sensor);
}

TEST(SelectPoints, AreHitsInTheOrderOfTheBeams) {
  const Cloud cloud = cloud_of(room_scan(0.02), {});
  for (const int most : {1, 7, 100, 400, 5000}) {
    CloudParams params = kCloudParams;
    params.match_points_max = most;
    std::vector<Point> points{Point(9.0F, 9.0F)};  // from before
    select_points(cloud, params, points);
    ASSERT_FALSE(points.empty());
    EXPECT_LE(points.size(), static_cast<std::size_t>(most));
    auto at = cloud.points.begin();
    for (const Point& p : points) {
      at = std::find(at, cloud.points.end(), p);
      ASSERT_NE(at, cloud.points.end());
      ++at;
    }
  }
}

TEST(MakeSurfels, TurnWithTheCloud) {
  const types::Scan scan = room_scan(0.01);
  const types::Se2 mount{-0.2, 0.15, -1.1};
  const std::vector<Surfel> here = make_surfels(cloud_of(scan, {}), kCloudParams);
  const std::vector<Surfel> there = make_surfels(cloud_of(scan, mount), kCloudParams);
  ASSERT_EQ(here.size(), there.size());
  std::ptrdiff_t alike = 0;
  for (std::size_t i = 0; i < here.size(); ++i) {
    const types::Vector2 position = mount * types::Vector2(here[i].position.cast<double>());
    const types::Vector2 end = mount * types::Vector2((here[i].position + here[i].normal).cast<double>());
    const bool is_alike = (there[i].position.cast<double>() - position).norm() < 1e-3 &&
                          (there[i].normal.cast<double>() - (end - position)).norm() < 1e-2;
    alike += is_alike && here[i].planar == there[i].planar ? 1 : 0;
    EXPECT_NEAR(there[i].normal.norm(), 1.0F, 1e-5F);
  }
  EXPECT_GE(alike, std::ssize(here) - 2) << "but for rounding at a limit";
}

TEST(MakeSurfels, OfLoneHitsThereAreNone) {
  Cloud cloud;
  EXPECT_TRUE(make_surfels(cloud, kCloudParams).empty());
  for (int i = 0; i < 10; ++i) {
    cloud.points.emplace_back(2.0F, static_cast<float>(i));
    cloud.spacing_m.push_back(0.02F);
  }
  EXPECT_TRUE(make_surfels(cloud, kCloudParams).empty()) << "a metre from each other";
}

}  // namespace
}  // namespace topo::slam
