// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/contact/contact.hpp"

#include <gtest/gtest.h>

namespace topo::bench {
namespace {

ContactSetup apart(std::uint32_t keyframes, double loss) {
  ContactSetup setup;
  setup.keyframes = keyframes;
  setup.loss = loss;
  setup.steady_s = 40.0;
  return setup;
}

TEST(Contact, RobotsThatWereApartHaveTheSameSetsInTheEnd) {
  for (const double loss : {0.0, 0.3, 0.7}) {
    const ContactResult result = run_contact(apart(80, loss));
    EXPECT_TRUE(result.same_sets) << loss;
    EXPECT_LE(result.catch_up_bytes_per_s, 205'000.0) << loss;
  }
}

TEST(Contact, TwoAsWellAsFive) {
  for (const int robots : {2, 5}) {
    ContactSetup setup = apart(60, 0.3);
    setup.robots = robots;
    EXPECT_TRUE(run_contact(setup).same_sets) << robots;
  }
}

TEST(Contact, IncompleteItemsStayWithinWhatIsWantedAtOnce) {
  const ContactSetup setup = apart(600, 0.3);
  const team::CapParams caps;
  const double window =
      static_cast<double>((caps.oldest_wanted + caps.newest_wanted) * setup.keyframe_bytes) *
      (setup.robots - 1);
  EXPECT_LT(static_cast<double>(run_contact(setup).assembly_bytes_max), 1.2 * window);
}

TEST(Contact, AfterwardsTheSteadyRateIsKept) {
  const ContactResult result = run_contact(apart(30, 0.0));
  EXPECT_LE(result.steady_bytes_per_s, 10'000.0);
  EXPECT_LE(result.steady_lag_s, 5.0);
}

TEST(Contact, TheSameSeedGivesTheSame) {
  const ContactResult one = run_contact(apart(40, 0.3)), other = run_contact(apart(40, 0.3));
  EXPECT_EQ(one.same_after_s, other.same_after_s);
  EXPECT_EQ(one.steady_bytes_per_s, other.steady_bytes_per_s);
}

}  // namespace
}  // namespace topo::bench
