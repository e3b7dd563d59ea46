// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/table/run_key.hpp"

#include <fmt/format.h>

namespace topo::bench {

std::string name_of(const Entrant& entrant) {
  const std::string radio = entrant.radio == "perfect" ? "" : ", " + entrant.radio;
  return fmt::format("{} x {}{}", entrant.robots, entrant.strategy, radio);
}

nlohmann::json json_of(const RunKey& key) {
  return {{"world", key.world},
          {"building", key.building},
          {"program", key.program},
          {"strategy", key.entrant.strategy},
          {"robots", key.entrant.robots},
          {"seed", key.seed},
          {"start", {key.start.x_m, key.start.y_m, key.start.theta_rad}},
          {"fidelity", key.fidelity},
          {"finish", key.finish},
          // Nobody else is there to hear.
          {"radio", key.entrant.robots > 1 ? key.entrant.radio : "none"},
          {"limit_s", key.limit_s}};
}

}  // namespace topo::bench
