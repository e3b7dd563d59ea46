// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>

#include "tests/bench/topobench/table/run_key.hpp"

namespace topo::bench::testing {

inline RunKey key_of(const std::string& world, const std::string& strategy, int robots, std::uint64_t seed) {
  RunKey key;
  key.world = world;
  key.building = "b";
  key.program = "p";
  key.entrant = {strategy, robots};
  key.seed = seed;
  key.start = {1.25, 2.5, 0.125};
  key.fidelity = "plan";
  key.finish = "complete";
  key.limit_s = 1000.0;
  return key;
}

/// A report of a run that went well: everything at home, `t` the time of 50 %, the others later.
inline nlohmann::json good_report(int robots, double t_s) {
  using nlohmann::json;
  json report{{"t50_s", t_s},
              {"t90_s", 2.0 * t_s},
              {"t95_s", 3.0 * t_s},
              {"t99_s", 4.0 * t_s},
              {"t_home_s", 5.0 * t_s},
              {"collisions", 0},
              {"distance_m", json::array()},
              {"home", json::array()},
              {"decision_ms", {{"mean", 1.0}, {"p99", 0.5 * t_s}, {"max", 9.0}}},
              {"coverage", json::array()}};
  for (int i = 0; i < robots; ++i) {
    report["distance_m"].push_back(10.0 + i);
    report["home"].push_back(true);
  }
  if (robots > 1) report["overlap"] = 0.25;
  for (int t = 1; t <= 20; ++t) report["coverage"].push_back({t, t / 20.0});
  return report;
}

}  // namespace topo::bench::testing
