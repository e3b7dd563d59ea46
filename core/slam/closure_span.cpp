// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/slam/closure_span.hpp"

#include <algorithm>

namespace topo::slam {
namespace {

/// Where a node is on a path; the path's length when it is not.
std::size_t place_on(Way way, std::size_t node) {
  const auto at = std::lower_bound(way.begin(), way.end(), node);
  return at != way.end() && *at == node ? static_cast<std::size_t>(at - way.begin()) : way.size();
}

}  // namespace

std::vector<bool> spanned_by_closures(std::span<const Edge> edges, std::span<const types::Se2> poses, Way way,
                                      double contradicted_chi2) {
  std::vector<int> opening(way.size() + 1, 0);
  for (const Edge& edge : edges) {
    if (!edge.robust) continue;
    const auto [earlier, later] = std::minmax({place_on(way, edge.from), place_on(way, edge.to)});
    if (later == way.size() || edge_chi2(edge, poses) > contradicted_chi2) continue;
    ++opening[earlier + 1];
    --opening[later + 1];
  }
  std::vector<bool> spanned(way.size(), false);
  int open = 0;
  for (std::size_t i = 0; i < way.size(); ++i) spanned[i] = (open += opening[i]) > 0;
  return spanned;
}

std::vector<WayStep> way_steps(std::span<const Edge> edges, std::span<const types::Se2> poses, Way way,
                               double contradicted_chi2) {
  const std::vector<bool> is_spanned = spanned_by_closures(edges, poses, way, contradicted_chi2);
  std::vector<WayStep> steps;
  for (const Edge& edge : edges) {
    if (edge.robust) continue;
    const std::size_t place = place_on(way, std::max(edge.from, edge.to));
    if (place == way.size() || place == 0 || way[place - 1] != std::min(edge.from, edge.to)) continue;
    steps.push_back({&edge, place, is_spanned[place]});
  }
  return steps;
}

}  // namespace topo::slam
