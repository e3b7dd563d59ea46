// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/types/se2.hpp"

namespace topo::team {

/// Lower x first, then lower y: a total order of points, independent of their order of arrival.
bool comes_before(const types::Vector2& a, const types::Vector2& b);

/// The cluster of each point, 0 to k - 1 (paper section II-F): k-means (Lloyd 1982) from a farthest-point
/// start (Gonzalez 1985), which begins with the point farthest from the mean. Depends only on the set of
/// points, not on their order; clusters are numbered by their first points (comes_before). When at most k
/// points are distinct, each is a cluster. Precondition: k > 0, coordinates finite. Cost: points times k per
/// round, with a bounded number of rounds.
std::vector<std::size_t> k_means(std::span<const types::Vector2> points, std::size_t k);

}  // namespace topo::team
