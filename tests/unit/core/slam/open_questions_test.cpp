// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/open_questions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
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

/// The questions by their definition: a node is asked about again when the newest correction put it elsewhere
/// than where it was asked about, it was not taken since, and no closed node is near it.
class QuestionsByDefinition {
 public:
  explicit QuestionsByDefinition(std::size_t apart) : apart_(apart) {}
  void ask(std::size_t node, double x_m) { asked_[node] = x_m; }
  void close(std::size_t node) {
    asked_.erase(node);
    closed_.push_back(node);
  }
  void correct(std::span<const Se2> poses) {
    moved_.clear();
    for (const auto& [node, x_m] : asked_)
      if (std::abs(poses[node].x_m - x_m) > 0.15) moved_.push_back(node);
  }
  std::optional<std::size_t> take() {
    while (!moved_.empty()) {
      const std::size_t node = moved_.front();
      moved_.erase(moved_.begin());
      const auto is_near = [&](std::size_t closed) {
        return std::max(node, closed) - std::min(node, closed) < apart_;
      };
      if (std::none_of(closed_.begin(), closed_.end(), is_near)) return node;
    }
    return std::nullopt;
  }

 private:
  std::size_t apart_;
  std::map<std::size_t, double> asked_;
  std::vector<std::size_t> closed_, moved_;
};

TEST(OpenQuestions, AreWhatTheDefinitionSays) {
  int taken = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    std::mt19937 random(seed);
    const std::size_t apart = 1 + random() % 4;
    OpenQuestions questions(0.15, 0.05, apart);
    QuestionsByDefinition expected(apart);
    std::vector<Se2> poses(40);
    for (int step = 0; step < 80; ++step) {
      const std::size_t node = random() % poses.size();
      const auto action = random() % 12;
      if (action < 5) {
        questions.ask(node, poses[node]);
        expected.ask(node, poses[node].x_m);
      } else if (action == 5) {
        questions.close(node);
        expected.close(node);
      } else if (action < 9) {
        for (Se2& pose : poses) pose.x_m += 0.1 * static_cast<double>(random() % 3);
        questions.correct(poses);
        expected.correct(poses);
      } else {
        const auto again = questions.take();
        EXPECT_EQ(again, expected.take()) << seed;
        taken += again ? 1 : 0;
      }
    }
  }
  EXPECT_GT(taken, 100);
}

}  // namespace
}  // namespace topo::slam
