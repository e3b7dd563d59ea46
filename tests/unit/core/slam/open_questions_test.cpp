// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/open_questions.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace topo::slam {
namespace {

using types::Se2;

std::vector<std::size_t> all_of(OpenQuestions& questions) {
  std::vector<std::size_t> all;
  while (const auto node = questions.take()) all.push_back(*node);
  return all;
}

TEST(OpenQuestions, WhatACorrectionMovedIsAskedAgainOnceTheOldestFirst) {
  OpenQuestions questions(0.15, 0.05, 1);
  questions.ask(3, {3.0, 0.0, 0.0});
  questions.ask(1, {1.0, 0.0, 3.14});
  questions.ask(2, {2.0, 0.0, 0.0});
  questions.ask(0, {0.0, 0.0, 0.0});
  EXPECT_TRUE(all_of(questions).empty()) << "nothing was corrected yet";
  questions.correct(std::vector<Se2>{{0.1, 0.0, 0.0}, {1.0, 0.0, -3.14}, {2.0, 0.0, 0.1}, {3.0, 0.2, 0.0}});
  EXPECT_EQ(all_of(questions), (std::vector<std::size_t>{2, 3}));
  EXPECT_TRUE(all_of(questions).empty());
}

TEST(OpenQuestions, MovementIsCountedFromWhereItWasAskedLast) {
  OpenQuestions questions(0.15, 0.05, 1);
  questions.ask(0, {});
  questions.correct(std::vector<Se2>{{0.1, 0.0, 0.0}});
  EXPECT_TRUE(all_of(questions).empty());
  questions.correct(std::vector<Se2>{{0.2, 0.0, 0.0}});
  ASSERT_EQ(all_of(questions).size(), 1U);
  questions.ask(0, {0.2, 0.0, 0.0});
  questions.correct(std::vector<Se2>{{0.3, 0.0, 0.0}});
  EXPECT_TRUE(all_of(questions).empty());
}

TEST(OpenQuestions, WhatIsClosedOrMovedBackIsNotAskedAgain) {
  OpenQuestions questions(0.15, 0.05, 1);
  questions.ask(0, {});
  questions.ask(1, {});
  const std::vector<Se2> moved{{1.0, 0.0, 0.0}, {1.0, 0.0, 0.0}};
  questions.correct(moved);
  questions.close(0);
  EXPECT_EQ(all_of(questions), std::vector<std::size_t>{1});
  questions.correct(moved);
  questions.correct(std::vector<Se2>(2));
  EXPECT_TRUE(all_of(questions).empty());
}

TEST(OpenQuestions, BesideAClosureNothingIsAskedAgain) {
  OpenQuestions questions(0.15, 0.05, 3);
  for (std::size_t node = 0; node < 10; ++node) questions.ask(node, {});
  questions.close(5);
  questions.correct(std::vector<Se2>(10, Se2{1.0, 0.0, 0.0}));
  EXPECT_EQ(questions.take(), 0U);
  questions.close(0);
  EXPECT_EQ(questions.take(), 8U) << "3 to 7 are beside the first closure, 1 and 2 beside the second";
  EXPECT_EQ(questions.take(), 9U);
  EXPECT_FALSE(questions.take());
}

}  // namespace
}  // namespace topo::slam
