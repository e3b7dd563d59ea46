// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/perception/scan_look.hpp"

#include <gtest/gtest.h>

#include <memory>

#include <array>

#include "tests/unit/core/motion/generators.hpp"
#include "tests/unit/core/motion/surroundings.hpp"

namespace topo::perception {
namespace {

using motion::empty_scan;
using motion::uniform;

using types::Vector2;

/// A scan of some beams, each of which measures a distance or nothing, or fails.
std::unique_ptr<types::Scan> any_beams() {
  auto scan = empty_scan(types::stamp_from_seconds(5.0));
  scan->beams = static_cast<std::uint16_t>(*rc::gen::inRange(2, 200));
  scan->geometry.angle_min_rad = static_cast<float>(uniform(-3.0, -0.2));
  scan->geometry.angle_increment_rad = static_cast<float>(uniform(0.004, 0.03));
  const float invalid = *rc::gen::element(types::kInvalid, types::kTooNear);
  const int share = *rc::gen::inRange(1, 30);
  for (std::size_t i = 0; i < scan->beams; ++i) {
    const auto range_m = static_cast<float>(uniform(0.2, 8.0));
    scan->range_m[i] =
        *rc::gen::inRange(0, share) != 0 ? range_m : *rc::gen::element(types::kNoReturn, invalid);
  }
  return scan;
}

TEST(ScanLook, OfASensorThatStandsIsTheScan) {
  EXPECT_TRUE(rc::check([] {
    const auto scan = any_beams();
    ScanLook look;
    RC_ASSERT(take_look(*scan, 0.0, look));
    RC_ASSERT(look.beams == scan->beams);
    RC_ASSERT(look.range_max_m == 30.0);
    for (std::size_t i = 0; i < look.beams; ++i) {
      const double range_m = static_cast<double>(scan->range_m[i]),
                   angle = static_cast<double>(scan->angle_rad(i));
      RC_ASSERT(look.is_hit(i) == types::is_hit(scan->range_m[i]));
      if (!look.is_hit(i)) continue;
      RC_ASSERT(look.range_m[i] == scan->range_m[i]);
      RC_ASSERT((look.points[i] - range_m * Vector2(std::cos(angle), std::sin(angle))).norm() < 1e-4);
    }
  }));
}

/// The beams of a turning sensor point apart by what it turns between them, about the middle one.
TEST(ScanLook, OfASensorThatTurnsIsThatOfItsMiddleBeam) {
  EXPECT_TRUE(rc::check([] {
    const auto scan = any_beams();
    const double omega_radps = uniform(-1.5, 1.5);
    scan->geometry.time_increment_s = static_cast<float>(uniform(1e-5, 2e-4));
    const double between_s = static_cast<double>(scan->geometry.time_increment_s);
    const double middle = 0.5 * (scan->beams - 1.0);
    ScanLook look;
    RC_ASSERT(take_look(*scan, omega_radps, look));
    RC_ASSERT(std::abs(types::to_seconds(look.stamp - scan->first_beam) - middle * between_s) < 1e-8);
    for (std::size_t i = 0; i < look.beams; ++i) {
      if (!look.is_hit(i)) continue;
      const double turned_rad = omega_radps * between_s * (static_cast<double>(i) - middle);
      const double angle = static_cast<double>(scan->angle_rad(i)) + turned_rad;
      const double range_m = static_cast<double>(scan->range_m[i]);
      RC_ASSERT((look.points[i] - range_m * Vector2(std::cos(angle), std::sin(angle))).norm() < 1e-4);
      RC_ASSERT(std::abs(look.first_rad + look.step_rad * static_cast<double>(i) - angle) < 1e-5);
    }
  }));
}

TEST(ScanLook, IsNoneOfOneBeamOrOfBeamsThatStand) {
  const auto scan = empty_scan(types::stamp_from_seconds(5.0));
  ScanLook look;
  EXPECT_TRUE(take_look(*scan, 0.0, look));
  for (const float step_rad : {0.0F, types::kInvalid}) {
    scan->geometry.angle_increment_rad = step_rad;
    EXPECT_FALSE(take_look(*scan, 0.0, look)) << step_rad;
  }
  scan->geometry.angle_increment_rad = 0.004F;
  scan->geometry.time_increment_s = 1e-3F;
  EXPECT_FALSE(take_look(*scan, -5.0, look)) << "the sensor turns faster than its beams go on";
  scan->geometry.angle_increment_rad = -0.004F;
  EXPECT_FALSE(take_look(*scan, 5.0, look)) << "and so the other way round";
  scan->geometry.angle_increment_rad = 0.004F;
  scan->geometry.angle_min_rad = types::kInvalid;
  EXPECT_FALSE(take_look(*scan, 0.0, look));
  scan->geometry.angle_min_rad = -1.0F;
  for (const std::uint16_t beams : std::array<std::uint16_t, 3>{0, 1, 2}) {
    scan->beams = beams;
    EXPECT_EQ(take_look(*scan, 0.0, look), beams == 2) << beams;
  }
}

TEST(ScanLook, TheBeamTowardsAPointIsTheNearest) {
  EXPECT_TRUE(rc::check([] {
    const auto scan = any_beams();
    ScanLook look;
    RC_ASSERT(take_look(*scan, 0.0, look));
    const double angle = uniform(-3.1, 3.1), range_m = uniform(0.1, 9.0);
    const std::size_t beam = look.beam_towards(range_m * Vector2(std::cos(angle), std::sin(angle)));
    const double at = (angle - look.first_rad) / look.step_rad;
    if (beam < look.beams) {
      RC_ASSERT(std::abs(at - static_cast<double>(beam)) <= 0.5 + 1e-9);
    } else {
      RC_ASSERT(beam == look.beams);
      RC_ASSERT((at <= -0.5 + 1e-9 || at >= static_cast<double>(look.beams) - 0.5 - 1e-9));
    }
  }));
}

TEST(ScanLook, ClearTowardsADiscIsTheLeastOfItsBeams) {
  EXPECT_TRUE(rc::check([] {
    const auto scan = any_beams();
    ScanLook look;
    RC_ASSERT(take_look(*scan, 0.0, look));
    const double angle = uniform(-3.1, 3.1), away_m = uniform(0.1, 9.0), radius_m = uniform(0.0, 0.3);
    const Vector2 p = away_m * Vector2(std::cos(angle), std::sin(angle));
    const double clear_m = look.clear_towards_m(p, radius_m);
    const std::size_t middle = look.beam_towards(p);
    if (middle == look.beams) {
      RC_ASSERT(clear_m == 0.0);
      return;
    }
    // Half the disc's angle in beams; one more is looked at on each side, as the middle one is rounded.
    const double half = radius_m / std::max(away_m, radius_m) / look.step_rad;
    double least_inside_m = 30.0, least_around_m = 30.0;
    for (std::size_t i = 0; i < look.beams; ++i) {
      const double off = std::abs(static_cast<double>(i) - static_cast<double>(middle));
      const float range = look.range_m[i];
      const double free_m = range == types::kNoReturn ? 30.0
                            : look.is_hit(i)          ? static_cast<double>(range)
                                                      : 0.0;
      if (off <= half) least_inside_m = std::min(least_inside_m, free_m);
      if (off <= half + 1.0) least_around_m = std::min(least_around_m, free_m);
    }
    RC_ASSERT(clear_m <= least_inside_m);
    RC_ASSERT(clear_m >= least_around_m);
    RC_ASSERT(look.clear_towards_m(p, radius_m + 0.1) <= clear_m);
  }));
}

/// A scanner that is mounted upside down counts its beams clockwise; what it sees is the same.
TEST(ScanLook, ClockwiseBeamsGiveTheSameLook) {
  auto upright = std::make_unique<types::Scan>(), turned = std::make_unique<types::Scan>();
  upright->geometry = {-2.0F, 0.01F, 0.0F, 0.025F, 0.1F, 30.0F};
  upright->beams = turned->beams = 401;
  turned->geometry = {2.0F, -0.01F, 0.0F, 0.025F, 0.1F, 30.0F};
  for (std::size_t i = 0; i < 401; ++i) {
    upright->range_m[i] = 1.0F + 0.01F * static_cast<float>(i);
    turned->range_m[400 - i] = upright->range_m[i];
  }
  upright->first_beam = turned->first_beam = types::stamp_from_seconds(5.0);
  auto a = std::make_unique<ScanLook>(), b = std::make_unique<ScanLook>();
  ASSERT_TRUE(take_look(*upright, 0.0, *a));
  ASSERT_TRUE(take_look(*turned, 0.0, *b));
  EXPECT_NEAR(a->first_rad, b->first_rad, 1e-5);
  EXPECT_NEAR(a->step_rad, b->step_rad, 1e-9);
  for (std::size_t i = 0; i < 401; ++i) {
    ASSERT_EQ(a->range_m[i], b->range_m[i]) << i;
    ASSERT_LT((a->points[i] - b->points[i]).norm(), 1e-4) << i;
  }
}

}  // namespace
}  // namespace topo::perception
