// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/skeleton/skeleton_graph.hpp"

#include <algorithm>
#include <bit>

#include "core/places/skeleton/fetch_ahead.hpp"
#include "core/types/invariant.hpp"

namespace topo::places {

int GraphTracer::count_around(std::uint32_t i) const { return thinning_->count_around(i, offsets_); }

void GraphTracer::add_node(std::uint32_t seed, bool whole_junction) {
  SkeletonNode node;
  node.first_cell = static_cast<std::uint32_t>(out_->axis.size());
  const auto id = static_cast<std::uint32_t>(out_->nodes.size()) + 1;
  const auto take = [&](std::uint32_t i) {
    thinning_->marks[i] |= Thinning::kNode;
    node_of_.set(i, id);
    out_->axis.push_back(i);
  };
  take(seed);
  for (std::size_t next = node.first_cell; whole_junction && next < out_->axis.size(); ++next) {
    const std::uint32_t i = out_->axis[next];
    for (unsigned around = thinning_->pattern_at(i, offsets_); around != 0; around &= around - 1) {
      const std::uint32_t j = neighbour(i, static_cast<std::size_t>(std::countr_zero(around)));
      if (!is_taken(j) && count_around(j) > 2) take(j);
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

/// Follows the axis from a node's cell over its neighbour in `direction` to the next node.
void GraphTracer::add_edge(std::uint32_t node, std::uint32_t from, std::size_t direction) {
  SkeletonEdge edge;
  edge.a = node;
  edge.first_cell = static_cast<std::uint32_t>(out_->axis.size());
  std::uint32_t here = neighbour(from, direction);
  edge.length_m = step_m(map_, direction);
  while (!is_taken(here)) {
    thinning_->marks[here] |= Thinning::kEdge;
    out_->axis.push_back(here);
    // A cell of an edge has two neighbours: the previous cell and the next.
    const unsigned back = 1U << ((direction + 4) % 8);
    const unsigned ahead = thinning_->pattern_at(here, offsets_) & ~back;
    types::require(ahead != 0, "places::GraphTracer: an edge that ends before a node");
    direction = static_cast<std::size_t>(std::countr_zero(ahead));
    here = neighbour(here, direction);
    edge.length_m += step_m(map_, direction);
  }
  edge.b = node_of_.at(here) - 1;
  edge.cell_count = static_cast<std::uint32_t>(out_->axis.size()) - edge.first_cell;
  ++out_->nodes[edge.a].degree;
  ++out_->nodes[edge.b].degree;
  out_->edges.push_back(edge);
  ends_.push_back({from, here});
}

void GraphTracer::add_edges_of(std::uint32_t node) {
  const SkeletonNode copy = out_->nodes[node];
  for (std::uint32_t n = 0; n < copy.cell_count; ++n) {
    const std::uint32_t from = out_->axis[copy.first_cell + n];
    for (unsigned around = thinning_->pattern_at(from, offsets_); around != 0; around &= around - 1) {
      const auto direction = static_cast<std::size_t>(std::countr_zero(around));
      const std::uint32_t j = neighbour(from, direction);
      if ((thinning_->marks[j] & Thinning::kEdge) != 0) continue;
      // Two touching nodes have an edge without cells: found from both, added once.
      if (!is_taken(j) || node_of_.at(j) - 1 > node) add_edge(node, from, direction);
    }
  }
}

/// The cells that are neither node nor edge form rings; the clearest cell of a ring becomes its node.
void GraphTracer::add_rings() {
  for (auto it = thinning_->remain.rbegin(); it != thinning_->remain.rend(); ++it) {
    if (is_taken(*it)) continue;
    add_node(*it, false);
    add_edges_of(static_cast<std::uint32_t>(out_->nodes.size()) - 1);
  }
}

void GraphTracer::find_narrowest(Skeleton& skeleton) const {
  for (std::size_t e = 0; e < skeleton.edges.size(); ++e) {
    SkeletonEdge& edge = skeleton.edges[e];
    edge.clearance_min_m = std::min(clearance_m_[ends_[e][0]], clearance_m_[ends_[e][1]]);
    for (std::size_t k = edge.first_cell; k < edge.first_cell + edge.cell_count; ++k) {
      fetch_ahead(clearance_m_.data(), skeleton.axis, k);
      edge.clearance_min_m = std::min(edge.clearance_min_m, clearance_m_[skeleton.axis[k]]);
    }
  }
}

void GraphTracer::trace(Thinning& thinning, Skeleton& skeleton) {
  thinning_ = &thinning;
  out_ = &skeleton;
  ends_.clear();
  skeleton.axis.reserve(thinning.remain.size());
  for (std::size_t k = 0; k < thinning.remain.size(); ++k) {
    const std::uint32_t i = thinning.remain[k];
    if (k + kFetchAhead < thinning.remain.size())
      fetch_around(thinning, thinning.remain[k + kFetchAhead], offsets_);
    if (is_taken(i)) continue;
    const int around = count_around(i);
    if (around != 2) add_node(i, around > 2);
  }
  for (std::uint32_t node = 0; node < skeleton.nodes.size(); ++node) add_edges_of(node);
  add_rings();
}

}  // namespace topo::places
