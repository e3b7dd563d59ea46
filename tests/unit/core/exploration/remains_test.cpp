// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/exploration/remains.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/unit/core/exploration/toy_decision.hpp"

namespace topo::exploration {
namespace {

/// The corridor with a wall across it, 1.75 m from the robot, and an opening of `chars` by 0.25 m in that.
std::vector<std::string> with_opening(std::size_t chars) {
  std::vector<std::string> rows = corridor_and_rooms();
  for (std::size_t y = 11; y < 16; ++y)
    if (y < 12 || y >= 12 + chars) rows[y].replace(47, 2, 2, '#');
  return rows;
}

class NarrowOpening : public ToyDecision {
 protected:
  NarrowOpening() : ToyDecision(with_opening(2)) {}
};
class WideOpening : public ToyDecision {
 protected:
  WideOpening() : ToyDecision(with_opening(3)) {}
};

TEST_F(NarrowOpening, IsNamedWithItsWidthAndWithWhatIsNeeded) {
  const Intent intent = note_what_remains(situation(), map_, params_, Intent());
  const std::string begins = "too narrow: an opening of ";
  int beyond = 0;
  for (const Decision& d : intent.log.decisions) {
    if (!d.text.starts_with(begins) || d.p_map.x() < here().x()) continue;
    ++beyond;
    EXPECT_NEAR(std::strtod(d.text.c_str() + begins.size(), nullptr), 0.5, 0.11) << d.text;
    EXPECT_NEAR(d.p_map.x(), here().x() + 1.9, 0.4);
    EXPECT_TRUE(d.text.ends_with(" m, 0.59 m needed")) << d.text;
  }
  EXPECT_EQ(beyond, 1);
}

TEST_F(WideOpening, IsNotNamed) {
  const Intent intent = note_what_remains(situation(), map_, params_, Intent());
  EXPECT_FALSE(has_note(intent, "too narrow"));
}

TEST_F(NarrowOpening, GoalsThatAreLeftOutAreNamedWithGainAndTime) {
  Intent intent;
  intent.outlook.left_out.push_back({{1.0, 2.0}, 0.44, 31.2});
  intent = note_what_remains(situation(), map_, params_, std::move(intent));
  EXPECT_TRUE(has_note(intent, "left out: 0.4 m2 for 31 s"));
}

}  // namespace
}  // namespace topo::exploration
