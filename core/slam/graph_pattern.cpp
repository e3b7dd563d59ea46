// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/graph_pattern.hpp"

#include <numeric>

namespace topo::slam {

bool is_connected(std::size_t nodes, std::span<const Edge> edges) {
  std::vector<std::size_t> parent(nodes);
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&](std::size_t node) {
    while (parent[node] != node) node = parent[node] = parent[parent[node]];
    return node;
  };
  std::size_t parts = nodes;
  for (const Edge& edge : edges) {
    const std::size_t a = root(edge.from), b = root(edge.to);
    if (a == b) continue;
    parent[a] = b;
    --parts;
  }
  return parts <= 1;
}

GraphPattern::GraphPattern(std::size_t nodes, std::span<const Edge> edges, std::size_t fixed)
    : fixed_(fixed), elimination_(nodes - 1, variable_links(edges)) {
  places_.reserve(edges.size());
  for (const Edge& edge : edges) {
    EdgePlaces places;
    places.has_from = edge.from != fixed_;
    places.has_to = edge.to != fixed_;
    places.from_variable = variable(edge.from);
    places.to_variable = variable(edge.to);
    if (places.has_from) places.from = elimination_.place(places.from_variable, places.from_variable);
    if (places.has_to) places.to = elimination_.place(places.to_variable, places.to_variable);
    if (places.has_from && places.has_to)
      places.between = elimination_.place(places.from_variable, places.to_variable);
    places_.push_back(places);
  }
}

std::vector<Elimination::Link> GraphPattern::variable_links(std::span<const Edge> edges) const {
  std::vector<Elimination::Link> links;
  links.reserve(edges.size());
  for (const Edge& edge : edges) {
    if (edge.from != fixed_ && edge.to != fixed_) links.emplace_back(variable(edge.from), variable(edge.to));
  }
  return links;
}

}  // namespace topo::slam
