// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/exploration/strategy.hpp"

#include <gtest/gtest.h>

#include <array>

namespace topo::exploration {
namespace {

constexpr std::array kAll{Strategy::kTopometric, Strategy::kNearestFrontier, Strategy::kGreedyFrontier,
                          Strategy::kUtilityFrontier, Strategy::kMinPos};

TEST(Strategy, EveryNameLeadsBackToItsRow) {
  for (const Strategy strategy : kAll) {
    EXPECT_EQ(row_of(strategy).strategy, strategy);
    EXPECT_EQ(strategy_of(to_text(strategy)), strategy);
    EXPECT_EQ(strategy_names()[static_cast<std::size_t>(strategy)], to_text(strategy));
  }
}

TEST(Strategy, AnUnknownNameIsNone) {
  EXPECT_FALSE(strategy_of("topometrical").has_value());
  EXPECT_FALSE(strategy_of("").has_value());
}

TEST(Strategy, OnlyTheNearestFrontierIsUncoordinated) {
  for (const Strategy strategy : kAll) {
    EXPECT_EQ(row_of(strategy).rule == team::Rule::kAlone, strategy == Strategy::kNearestFrontier)
        << to_text(strategy);
  }
}

TEST(Strategy, OnlyThePapersTours) {
  for (const Strategy strategy : kAll) EXPECT_EQ(row_of(strategy).tours, strategy == Strategy::kTopometric);
}

}  // namespace
}  // namespace topo::exploration
