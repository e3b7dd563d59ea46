// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tests/bench/topobench/fresh/layouts.hpp"

namespace topo::bench::fresh {

/// At which sides of a block there is a corridor.
struct Sides {
  bool left = false, right = false, below = false, above = false;
  [[nodiscard]] bool beside() const { return left || right; }
  [[nodiscard]] bool across() const { return below || above; }
};

/// A row of rooms along x or along y.
void add_row(const Box& box, bool along_x, const LayoutRules& rules, sim::Random& random,
             std::vector<Space>& out);
/// A block, by corridors into rows of rooms as deep as the rules say.
void divide(const Box& box, const Sides& corridors, const LayoutRules& rules, sim::Random& random,
            std::vector<Space>& out);

}  // namespace topo::bench::fresh
