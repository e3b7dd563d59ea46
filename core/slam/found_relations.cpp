// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/slam/found_relations.hpp"

namespace topo::slam {

std::vector<FoundRelation> found_relations(std::span<const KeyframePtr> keyframes,
                                           std::span<const Edge> edges) {
  std::vector<FoundRelation> found;
  for (const Edge& edge : edges) {
    if (!has_finder(edge)) continue;
    found.push_back({edge.finder,
                     {keyframes[edge.from]->id, keyframes[edge.to]->id},
                     {edge.T_from_to, edge.information, edge.robust}});
  }
  return found;
}

}  // namespace topo::slam
