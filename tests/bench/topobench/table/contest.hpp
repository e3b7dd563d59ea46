// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/types/result.hpp"
#include "tests/bench/topobench/table/run_key.hpp"

namespace topo::bench {

/// An entrant and whom it is held against: of several opponents in every world the best.
struct Contest {
  Entrant a;
  std::vector<Entrant> b;
};

/// What stands for all opponents that are neither topometric nor one of its ablations.
inline constexpr const char* kBestBaseline = "best_baseline";

/// "2 x min_pos", or "2 x best_baseline" of several.
std::string name_of_opponents(const Contest& contest);

/// All combinations; one robot has no radio.
std::vector<Entrant> entrants_of(std::span<const std::string> strategies, std::span<const int> robots,
                                 std::span<const std::string> radios);

/// "A:2/B:1": two robots that go by A against one that goes by B, which may be best_baseline. A radio can
/// follow ("A:2:range:15"); without one it is the first that there is. An error says what it should be, or
/// who is not among the entrants.
types::Result<Contest> parse_contest(const std::string& text, std::span<const Entrant> entrants);

/// The first entrant's strategy against every other one, and against the best baseline if there are several,
/// with as many robots and the same radio; with the first of the radios against all with one robot; and with
/// every other radio against itself with the first.
std::vector<Contest> usual_contests(std::span<const Entrant> entrants);

}  // namespace topo::bench
