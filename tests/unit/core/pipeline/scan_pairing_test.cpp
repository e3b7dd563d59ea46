// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/pipeline/scan_pairing.hpp"

#include <gtest/gtest.h>

#include <memory>

namespace topo::pipeline {
namespace {

constexpr double kWait_s = 0.3;

types::Stamp at(double t_s) { return types::stamp_from_seconds(50.0 + t_s); }

std::unique_ptr<types::Scan> scan_at(double t_s) {
  auto scan = std::make_unique<types::Scan>();
  scan->first_beam = at(t_s);
  scan->beams = 2;
  scan->geometry.time_increment_s = 0.025F;
  return scan;
}

types::Odometry odometry_at(double t_s) {
  types::Odometry sample;
  sample.stamp = at(t_s);
  sample.T_odom_base = types::Transform2<types::Odom, types::Base>(t_s, 0.0, 0.0);
  return sample;
}

void add(ScanPairing& pairing, double t_s) {
  const types::Odometry sample = odometry_at(t_s);
  pairing.add({&sample, 1});
}

TEST(ScanPairing, AScanBeforeAnyOdometryIsLostAndCounted) {
  ScanPairing pairing(kWait_s);
  pairing.add_front(*scan_at(0.0));
  EXPECT_EQ(pairing.losses().without_odometry, 1U);
  EXPECT_FALSE(pairing.next_front(true).has_value());
}

TEST(ScanPairing, AScanWaitsForOdometryAfterItsEnd) {
  ScanPairing pairing(kWait_s);
  add(pairing, 0.0);
  pairing.add_front(*scan_at(0.01));
  EXPECT_FALSE(pairing.next_front(false).has_value());
  add(pairing, 0.1);
  const auto paired = pairing.next_front(false);
  ASSERT_TRUE(paired.has_value());
  EXPECT_NEAR(paired->first.x_m, 0.01, 1e-9);
  EXPECT_NEAR(paired->last.x_m, 0.035, 1e-6);
  EXPECT_FALSE(pairing.next_front(true).has_value()) << "each once";
}

TEST(ScanPairing, TheWaitEndsByTheNewestScan) {
  ScanPairing pairing(kWait_s);
  add(pairing, 0.0);
  add(pairing, 0.02);
  pairing.add_front(*scan_at(0.01));
  pairing.add_coronal(*scan_at(0.2));
  EXPECT_FALSE(pairing.next_front(false).has_value());
  pairing.add_coronal(*scan_at(0.4));
  EXPECT_TRUE(pairing.next_front(false).has_value());
}

TEST(ScanPairing, OfTooManyTheOldestIsDroppedAndCounted) {
  ScanPairing pairing(kWait_s);
  add(pairing, 0.0);
  for (int i = 0; i < 17; ++i) pairing.add_front(*scan_at(0.001 * i));
  EXPECT_EQ(pairing.losses().queue_full, 1U);
  add(pairing, 1.0);
  const auto paired = pairing.next_front(false);
  ASSERT_TRUE(paired.has_value());
  EXPECT_EQ(paired->scan.first_beam, at(0.001));
}

TEST(ScanPairing, KeepsAsManyAsItsParametersSay) {
  MappingStepParams params;
  params.scans_waiting_max = 2;
  ScanPairing pairing(kWait_s, params);
  add(pairing, 0.0);
  for (int i = 0; i < 5; ++i) pairing.add_front(*scan_at(0.001 * i));
  EXPECT_EQ(pairing.losses().queue_full, 3U);
}

}  // namespace
}  // namespace topo::pipeline
