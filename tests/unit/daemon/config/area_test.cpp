// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include "daemon/config/polygon.hpp"
#include "tests/unit/daemon/config/sample.hpp"

namespace topo::daemon {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

std::string area(const std::string& lines) { return std::string(kSmallest) + "[area]\n" + lines; }

TEST(Area, IsReadAndGoesToThePlanner) {
  const auto loaded = parse_configuration(area(R"(keep_in_m = [[-1, -1], [5.5, -1], [5.5, 4], [-1, 4]]
keep_out_m = [[[2, 2], [3, 2], [3, 3]], [[4, 2], [5, 2], [5, 3]]]
)"),
                                          "f.toml");
  ASSERT_EQ(faults_text(loaded), "");
  ASSERT_TRUE(loaded.values.area.keep_in.has_value());
  EXPECT_EQ(loaded.values.area.keep_in->at(1), (types::Vector2{5.5, -1.0}));
  EXPECT_EQ(loaded.values.area.keep_out.size(), 2U);
  EXPECT_FALSE(planner_params(loaded.values).area.empty());
  const auto again = parse_configuration(effective_text(loaded), "again.toml");
  EXPECT_EQ(faults_text(again), "");
  EXPECT_EQ(again.values.area.keep_out, loaded.values.area.keep_out);
}

TEST(Area, NoneByDefaultAndByEmptyLists) {
  const auto loaded = parse_configuration(area("keep_in_m = []\nkeep_out_m = []\n"), "f.toml");
  EXPECT_THAT(loaded.faults, IsEmpty());
  EXPECT_TRUE(loaded.values.area.empty());
}

TEST(Area, FaultsNameTheCorner) {
  EXPECT_THAT(faults_of(area("keep_in_m = [[-1, -1], [5, -1]]\n")),
              ElementsAre(AllOf(StartsWith("8:13: area.keep_in_m: "), HasSubstr("2 corners make no area"))));
  EXPECT_THAT(faults_of(area("keep_in_m = [[-1, -1], [5, inf], [5, 5]]\n")),
              ElementsAre(AllOf(StartsWith("8:24: area.keep_in_m: "), HasSubstr("corner 2 is no pair"))));
  EXPECT_THAT(faults_of(area("keep_in_m = [[-1, -1], [5, -1, 0], [5, 5]]\n")),
              ElementsAre(HasSubstr("corner 2 is no pair")));
  EXPECT_THAT(faults_of(area("keep_in_m = 7\n")), ElementsAre(HasSubstr("found 7, expected corners")));
  EXPECT_THAT(faults_of(area("keep_out_m = [[1, 2], [3, 4], [5, 5]]\n")),
              ElementsAre(AllOf(StartsWith("8:"), HasSubstr("corner 1 is no pair"))));
}

TEST(Area, EdgesThatCrossOrTouch) {
  for (const char* polygon : {
           "[[-1, -1], [1, 1], [1, -1], [-1, 1]]",           // a bow
           "[[-1, -1], [1, -1], [1, 1], [0, -1], [-1, 1]]",  // a corner on an edge
           "[[-1, -1], [1, -1], [1, 1], [1, -1], [-1, 1]]",  // a spike
           "[[-1, -1], [-1, -1], [1, -1], [1, 1]]",          // a corner twice
           "[[-1, -1], [0, -1], [1, -1]]",                   // no area
       }) {
    EXPECT_THAT(faults_of(area(std::string("keep_in_m = ") + polygon + "\n")),
                ::testing::Contains(HasSubstr("crosses or touches")))
        << polygon;
  }
}

TEST(Area, TheStartMustBeAllowed) {
  EXPECT_THAT(faults_of(area("keep_in_m = [[1, 1], [5, 1], [5, 5]]\n")),
              ElementsAre(StartsWith("8:1: area.keep_in_m: the start (0, 0) is outside")));
  EXPECT_THAT(faults_of(area("keep_out_m = [[[1, 1], [2, 1], [2, 2]], [[-1, -1], [1, -1], [0, 1]]]\n")),
              ElementsAre(StartsWith("8:1: area.keep_out_m: the start (0, 0) is in area 2")));
}

}  // namespace
}  // namespace topo::daemon
