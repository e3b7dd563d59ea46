// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/posegraph/node_name.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <vector>

namespace topo::bench {
namespace {

TEST(NodeName, OrdersNumbersByValueAndNamesByTheirEnd) {
  std::vector<std::string> words{"b2", "10", "a10", "9", "18446744073709551616", "a9", "6989586621679009793"};
  std::sort(words.begin(), words.end(), [](const std::string& a, const std::string& b) {
    return *parse_node_name(a) < *parse_node_name(b);
  });
  EXPECT_THAT(words, ::testing::ElementsAre("9", "10", "6989586621679009793", "18446744073709551616", "a9",
                                            "a10", "b2"));
}

TEST(NodeName, TakesWordsThatAreNamesAlone) {
  for (const char* word : {"", "-1", "1.5", "1,5", "a b", ":", "x\n"})
    EXPECT_FALSE(parse_node_name(word)) << word;
  EXPECT_FALSE(parse_node_name(std::string(65, '1')));
  EXPECT_EQ(parse_node_name("007"), parse_node_name("7"));
  EXPECT_EQ(parse_node_name("000")->text(), "0");
  EXPECT_NE(parse_node_name("x07"), parse_node_name("x7"));
  EXPECT_EQ(parse_node_name("robot_1")->text(), "robot_1");
}

TEST(NodeName, TellsRobotsApart) {
  EXPECT_EQ(parse_node_name("3")->robot(), parse_node_name("4000000000")->robot());
  EXPECT_EQ(parse_node_name("6989586621679009792")->robot(), parse_node_name("6989586621679009793")->robot());
  EXPECT_NE(parse_node_name("6989586621679009793")->robot(), parse_node_name("7061644215716937728")->robot());
  EXPECT_NE(parse_node_name("a1")->robot(), parse_node_name("b1")->robot());
}

}  // namespace
}  // namespace topo::bench
