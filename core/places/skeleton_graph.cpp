// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/skeleton_graph.hpp"

#include <algorithm>

namespace topo::places {

int GraphTracer::count_around(std::uint32_t i) const {
  int count = 0;
  for (std::size_t k = 0; k < 8; ++k) count += marks_[neighbour(i, k)] & Thinning::kOn;
  return count;
}

float GraphTracer::step_m(std::uint32_t a, std::uint32_t b) const {
  const auto distance = static_cast<std::ptrdiff_t>(a > b ? a - b : b - a);
  const bool straight = distance == 1 || distance == map_.width();
  return static_cast<float>(map_.resolution_m * (straight ? 1.0 : 1.41421356));
}

void GraphTracer::add_node(std::uint32_t seed, bool whole_junction) {
  SkeletonNode node;
  node.first_cell = static_cast<std::uint32_t>(out_->axis.size());
  const auto id = static_cast<std::uint32_t>(out_->nodes.size()) + 1;
  const auto take = [&](std::uint32_t i) {
    owner_[i] = id;
    out_->axis.push_back(i);
  };
  take(seed);
  for (std::size_t next = node.first_cell; whole_junction && next < out_->axis.size(); ++next) {
    for (std::size_t k = 0; k < 8; ++k) {
      const std::uint32_t j = neighbour(out_->axis[next], k);
      if ((marks_[j] & Thinning::kOn) != 0 && owner_[j] == kNobody && count_around(j) > 2) take(j);
    }
  }
  node.cell_count = static_cast<std::uint32_t>(out_->axis.size()) - node.first_cell;
  std::uint32_t best = seed;
  for (const std::uint32_t i : out_->cells_of(node)) {
    if (clearance_m_[i] > clearance_m_[best] || (clearance_m_[i] == clearance_m_[best] && i < best)) best = i;
  }
  node.cell = map_.cell(best);
  node.clearance_m = clearance_m_[best];
  out_->nodes.push_back(node);
}

/// Follows the axis from a node's cell over its neighbour `first` to the next node.
void GraphTracer::add_edge(std::uint32_t node, std::uint32_t from, std::uint32_t first) {
  SkeletonEdge edge;
  edge.a = node;
  edge.first_cell = static_cast<std::uint32_t>(out_->axis.size());
  edge.clearance_min_m = std::min(clearance_m_[from], clearance_m_[first]);
  edge.length_m = step_m(from, first);
  std::uint32_t last = from, here = first;
  while (owner_[here] == kNobody) {
    owner_[here] = kEdge;
    out_->axis.push_back(here);
    std::uint32_t next = here;
    for (std::size_t k = 0; k < 8; ++k) {
      const std::uint32_t j = neighbour(here, k);
      if ((marks_[j] & Thinning::kOn) != 0 && j != last) next = j;
    }
    edge.clearance_min_m = std::min(edge.clearance_min_m, clearance_m_[next]);
    edge.length_m += step_m(here, next);
    last = here;
    here = next;
  }
  edge.b = owner_[here] - 1;
  edge.cell_count = static_cast<std::uint32_t>(out_->axis.size()) - edge.first_cell;
  ++out_->nodes[edge.a].degree;
  ++out_->nodes[edge.b].degree;
  out_->edges.push_back(edge);
}

void GraphTracer::add_edges_of(std::uint32_t node) {
  const SkeletonNode copy = out_->nodes[node];
  for (std::uint32_t n = 0; n < copy.cell_count; ++n) {
    const std::uint32_t from = out_->axis[copy.first_cell + n];
    for (std::size_t k = 0; k < 8; ++k) {
      const std::uint32_t j = neighbour(from, k);
      if ((marks_[j] & Thinning::kOn) == 0 || owner_[j] == kEdge || owner_[j] == node + 1) continue;
      // Two nodes that touch have an edge without cells: found from both, made once.
      if (owner_[j] == kNobody || owner_[j] - 1 > node) add_edge(node, from, j);
    }
  }
}

/// What is neither node nor edge now is a ring; its clearest cell becomes its node.
void GraphTracer::add_rings(const Thinning& thinning) {
  for (auto it = thinning.remain.rbegin(); it != thinning.remain.rend(); ++it) {
    if (owner_[*it] != kNobody) continue;
    add_node(*it, false);
    add_edges_of(static_cast<std::uint32_t>(out_->nodes.size()) - 1);
  }
}

void GraphTracer::trace(const Thinning& thinning, Skeleton& skeleton) {
  marks_ = thinning.marks.data();
  out_ = &skeleton;
  for (const std::uint32_t i : skeleton.axis) owner_[i] = kNobody;  // of the run before
  skeleton.nodes.clear();
  skeleton.edges.clear();
  skeleton.axis.clear();
  for (const std::uint32_t i : thinning.remain) {
    if (owner_[i] != kNobody) continue;
    const int around = count_around(i);
    if (around != 2) add_node(i, around > 2);
  }
  for (std::uint32_t node = 0; node < skeleton.nodes.size(); ++node) add_edges_of(node);
  add_rings(thinning);
}

}  // namespace topo::places
