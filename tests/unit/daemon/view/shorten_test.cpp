// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/view/shorten.hpp"

#include <gtest/gtest.h>

namespace topo::daemon {
namespace {

TEST(Shorten, CountersThatNobodySeesAreLeftOut) {
  const Json status =
      Json::parse(R"({"robot": "r", "pose": {"x_m": 1.23456}, "devices": {"base": {"bytes": 12345}},
    "plausibility": {"doubts": [{"found": "f", "cure": "c"}], "lag_s": 0.1}, "map": {"keyframes": 3, "response": 0.7}})");
  EXPECT_EQ(shorten(Topic::kStatus, status), Json::parse(R"({"robot": "r", "pose": {"x_m": 1.235},
    "plausibility": {"doubts": [{"found": "f", "cure": "c"}]}, "map": {"keyframes": 3}})"));
}

TEST(Shorten, OfASessionOnlyWhetherItWaitsForThePlace) {
  const Json status = Json::parse(R"({"session": {"folder": "/f", "obstacle": "o", "journal": {"bytes": 7},
    "place": {"standing": "proposed", "session": "s", "waits": true, "proposed": {"x_m": 1.23456}, "trial": {}}}})");
  EXPECT_EQ(shorten(Topic::kStatus, status), Json::parse(R"({"session": {"place":
    {"standing": "proposed", "session": "s", "waits": true, "proposed": {"x_m": 1.235}}}})"));
}

TEST(Shorten, OfGoalsThePlacesReasonsAndTheLastDecision) {
  const Json goals = Json::parse(R"({"goal": null, "open": [{"x_m": 1, "opening_m": 0.70001}],
    "dropped": [{"x_m": 1, "y_m": 2, "why": "w", "opening_m": 3}], "decisions": [{"text": "a"}, {"text": "b"}],
    "goals_sum": 7})");
  EXPECT_EQ(shorten(Topic::kGoals, goals),
            Json::parse(R"({"goal": null, "open": [{"x_m": 1, "opening_m": 0.7}],
    "dropped": [{"x_m": 1, "y_m": 2}], "decisions": [{"text": "b"}]})"));
}

TEST(Shorten, OfADoubtWhyAndWhere) {
  const Json doubt = Json::parse(R"({"revision": 7, "figure": 1.2, "why": "w", "side_m": 2.0, "lost": 0.1,
    "regions": [{"x_m": 1.23456, "y_m": 2, "points": 30, "contradicted": 0.9}],
    "loose": [{"x_m": 3, "y_m": 4, "sigma_rad": 0.7}]})");
  EXPECT_EQ(shorten(Topic::kDoubt, doubt), Json::parse(R"({"why": "w", "side_m": 2.0,
    "regions": [{"x_m": 1.235, "y_m": 2}], "loose": [{"x_m": 3, "y_m": 4}]})"));
  EXPECT_EQ(shorten(Topic::kDoubt, nullptr), nullptr) << "not looked at yet";
}

TEST(Shorten, WhatIsNotAsExpectedIsLeftAlone) {
  EXPECT_EQ(shorten(Topic::kStatus, Json(3)), Json(3));
  EXPECT_EQ(shorten(Topic::kGoals, Json{{"decisions", "none"}, {"dropped", 1}}),
            (Json{{"decisions", "none"}, {"dropped", 1}}));
  EXPECT_EQ(shorten(Topic::kDoctor, Json{{"ok", true}}), (Json{{"ok", true}}));
}

}  // namespace
}  // namespace topo::daemon
