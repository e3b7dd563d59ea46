// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/plausibility/picture_check.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <numbers>
#include <random>

namespace topo::plausibility {
namespace {

/// A UTM-30LX: 1081 beams over 270 degrees.
class Pictures {
 public:
  Pictures() : scan(std::make_unique<types::Scan>()) {
    scan->beams = 1081;
    scan->geometry.angle_min_rad = static_cast<float>(-0.75 * std::numbers::pi);
    scan->geometry.angle_increment_rad = static_cast<float>(0.25 * std::numbers::pi / 180.0);
    scan->geometry.period_s = 0.025F;
  }
  void fill(double range_m) {
    std::normal_distribution<double> noise(range_m, 0.01);
    for (std::size_t i = 0; i < scan->beams; ++i) scan->range_m[i] = static_cast<float>(noise(random_));
  }
  /// The beams with an angle in [from, to), degrees.
  void set(double from_deg, double to_deg, float range_m) {
    for (std::size_t i = 0; i < scan->beams; ++i) {
      const double deg = static_cast<double>(scan->angle_rad(i)) * 180.0 / std::numbers::pi;
      if (deg >= from_deg && deg < to_deg) scan->range_m[i] = range_m;
    }
  }
  PictureOpinion show(PictureCheck& check, const types::Se2& mount = {}) {
    now_ += std::chrono::milliseconds(25);
    scan->arrival = now_;
    ++scan->sequence;
    return check.judge(*scan, mount);
  }

  std::unique_ptr<types::Scan> scan;

 private:
  std::mt19937 random_{3};
  types::Stamp now_ = types::stamp_from_seconds(9.0);
};

TEST(PictureCheck, believesARoomWithNoise) {
  Pictures pictures;
  PictureCheck check;
  for (int i = 0; i < 400; ++i) {
    pictures.fill(2.0);
    const PictureOpinion opinion = pictures.show(check);
    ASSERT_FALSE(opinion.blind || opinion.failed || opinion.frozen || opinion.covered) << i;
  }
}

TEST(PictureCheck, tenEqualPicturesAreFrozen) {
  Pictures pictures;
  PictureCheck check;
  pictures.fill(2.0);
  for (int i = 1; i <= 9; ++i) ASSERT_FALSE(pictures.show(check).frozen) << i;
  EXPECT_TRUE(pictures.show(check).frozen);
  pictures.fill(2.0);
  EXPECT_FALSE(pictures.show(check).frozen);
}

// A line that was held up gives its pictures at once, of which control sees the newest.
TEST(PictureCheck, picturesThatControlDidNotSeeCountAsEqual) {
  Pictures pictures;
  PictureCheck check;
  pictures.fill(2.0);
  ASSERT_FALSE(pictures.show(check).frozen);
  pictures.fill(2.0);
  pictures.scan->sequence += 7;
  ASSERT_FALSE(pictures.show(check).frozen) << "one picture is equal to no other, whatever its number";
  ASSERT_FALSE(pictures.show(check).frozen) << "nine";
  EXPECT_TRUE(pictures.show(check).frozen);
  pictures.fill(2.0);
  pictures.scan->sequence += 20;
  EXPECT_FALSE(pictures.show(check).frozen);
}

TEST(PictureCheck, aScannerStartedAnewBeginsToCountAnew) {
  Pictures pictures;
  PictureCheck check;
  pictures.scan->sequence = 500;
  pictures.fill(2.0);
  for (int i = 1; i <= 9; ++i) ASSERT_FALSE(pictures.show(check).frozen) << i;
  pictures.scan->sequence = 0;
  EXPECT_FALSE(pictures.show(check).frozen);
}

// A picture without ranges has no noise: what it is made of says more than that it repeats.
TEST(PictureCheck, aPictureWithoutRangesIsNamedByWhatItHas) {
  struct Case {
    float range_m;
    bool blind, failed, covered;
  };
  for (const Case& expected :
       {Case{types::kNoReturn, true, false, false}, Case{types::kInvalid, false, true, false},
        Case{types::kTooNear, false, false, true}, Case{0.03F, false, false, true}}) {
    Pictures pictures;
    PictureCheck check;
    pictures.set(-200.0, 200.0, expected.range_m);
    for (int i = 1; i <= 9; ++i) {
      const PictureOpinion early = pictures.show(check);
      ASSERT_FALSE(early.blind || early.failed || early.covered) << i;
    }
    for (int i = 0; i < 100; ++i) {
      const PictureOpinion opinion = pictures.show(check);
      EXPECT_FALSE(opinion.frozen);
      EXPECT_EQ(opinion.blind, expected.blind) << expected.range_m;
      EXPECT_EQ(opinion.failed, expected.failed) << expected.range_m;
      EXPECT_EQ(opinion.covered, expected.covered) << expected.range_m;
    }
    pictures.fill(2.0);
    const PictureOpinion over = pictures.show(check);
    EXPECT_FALSE(over.blind || over.failed || over.covered);
  }
}

TEST(PictureCheck, nothingAtAllIsNoFaultInOpenSpace) {
  Pictures pictures;
  PictureParams params;
  params.open_space = true;
  PictureCheck check(params);
  pictures.set(-200.0, 200.0, types::kNoReturn);
  for (int i = 0; i < 100; ++i) {
    const PictureOpinion opinion = pictures.show(check);
    ASSERT_FALSE(opinion.blind || opinion.failed || opinion.frozen || opinion.covered);
  }
}

TEST(PictureCheck, failedBeamsAheadForASecondAreTold) {
  Pictures pictures;
  PictureCheck check;
  for (int i = 0; i < 50; ++i) {
    pictures.fill(2.0);
    pictures.set(-91.0, 91.0, types::kInvalid);
    const PictureOpinion opinion = pictures.show(check);
    EXPECT_EQ(opinion.failed, i >= 40) << i;
    EXPECT_FALSE(opinion.blind || opinion.frozen);
  }
}

TEST(PictureCheck, aNoiselessScannerMayRepeat) {
  Pictures pictures;
  PictureParams params;
  params.noiseless = true;
  PictureCheck check(params);
  pictures.fill(2.0);
  for (int i = 1; i <= 50; ++i) ASSERT_FALSE(pictures.show(check).frozen);
}

TEST(PictureCheck, nothingAheadForASecondIsBlind) {
  Pictures pictures;
  PictureParams params;
  params.open_space = true;
  PictureCheck check, open(params);
  for (int i = 0; i < 50; ++i) {
    pictures.fill(2.0);  // behind the robot's shoulders the scanner still sees
    pictures.set(-91.0, 91.0, types::kNoReturn);
    EXPECT_FALSE(pictures.show(open).blind);
    const bool blind = pictures.show(check).blind;
    EXPECT_EQ(blind, i >= 20) << i;  // 50 ms a turn
  }
}

TEST(PictureCheck, aTenthOfTheViewIsEnoughToSee) {
  Pictures pictures;
  PictureCheck check;
  for (int i = 0; i < 100; ++i) {
    pictures.fill(2.0);
    pictures.set(-91.0, 72.0, types::kNoReturn);
    ASSERT_FALSE(pictures.show(check).blind);
  }
}

TEST(PictureCheck, aFifthOfTheViewAtTheWindowIsCovered) {
  Pictures pictures;
  for (const float range_m : {types::kTooNear, 0.03F}) {
    PictureCheck check;
    bool covered = false;
    for (int i = 0; i < 45; ++i) {
      pictures.fill(2.0);
      pictures.set(0.0, 40.0, range_m);
      covered = pictures.show(check).covered;
    }
    EXPECT_TRUE(covered);
    pictures.fill(2.0);
    pictures.set(0.0, 20.0, range_m);
    EXPECT_FALSE(pictures.show(check).covered);
  }
}

TEST(PictureCheck, forwardIsTheRobotsAndNotTheScanners) {
  Pictures pictures;
  pictures.fill(2.0);
  pictures.set(-91.0, 91.0, types::kNoReturn);
  const types::Se2 backwards{0.0, 0.0, std::numbers::pi};
  EXPECT_GT(forward_shares(*pictures.scan, {}, 0.08).empty, 0.99);
  EXPECT_LT(forward_shares(*pictures.scan, backwards, 0.08).empty, 0.05);
}

}  // namespace
}  // namespace topo::plausibility
