// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

namespace topo::bench::bound {

/// Lengths between stops, metres, in both directions alike; infinite where there is no way.
using Lengths = std::vector<std::vector<double>>;

/// Stops of each robot in their order, the place where it starts not among them.
using Tours = std::vector<std::vector<std::size_t>>;

/// From the robot's start over its stops; it ends at the last.
double open_length_m(const Lengths& lengths, std::size_t start, const std::vector<std::size_t>& stops);

/// Shares stops out to robots so that the longest open tour is short: cheapest insertion, then stops moved
/// within and between tours and parts turned round while that shortens the longest, or at the same longest
/// the sum. Good, not optimal. `starts`: numbers of the robots' starts in `lengths`.
Tours share_out(const Lengths& lengths, const std::vector<std::size_t>& starts,
                const std::vector<std::size_t>& stops);

/// Total length of a smallest tree that joins all of `nodes`.
double spanning_tree_m(const Lengths& lengths, const std::vector<std::size_t>& nodes);

}  // namespace topo::bench::bound
