// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "core/types/result.hpp"
#include "tests/sim/world.hpp"

namespace topo::bench {

struct BoundCommand {
  std::filesystem::path world;
  int robots = 1;
  std::vector<double> start;      ///< x, y, theta; empty: the world's
  std::filesystem::path picture;  ///< empty: none
  bool json = false;
};

/// What robots that know the building need to see its shares: REPORTS "topobench bound". Robots stand as
/// `topobench explore` puts them.
types::Result<nlohmann::json> bound_report(const BoundCommand& command);

/// `topobench bound`: prints that.
types::Status run_bound(const BoundCommand& command);

}  // namespace topo::bench
