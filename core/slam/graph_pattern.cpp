// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/graph_pattern.hpp"

#include <numeric>

namespace topo::slam {

namespace {

/// False of a heading alone.
bool says_where(const Edge& edge) { return edge.information.topLeftCorner<2, 2>().trace() > 0.0; }

}  // namespace

bool is_connected(std::size_t nodes, std::span<const Edge> edges, std::span<const std::size_t> fixed) {
  std::vector<std::size_t> parent(nodes);
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&](std::size_t node) {
    while (parent[node] != node) node = parent[node] = parent[parent[node]];
    return node;
  };
  std::size_t parts = nodes;
  const auto join = [&](std::size_t one, std::size_t other) {
    const std::size_t a = root(one), b = root(other);
    if (a == b) return;
    parent[a] = b;
    --parts;
  };
  for (const Edge& edge : edges) {
    if (says_where(edge)) join(edge.from, edge.to);
  }
  for (const std::size_t node : fixed) join(fixed.front(), node);
  return parts <= 1;
}

namespace {

std::vector<std::size_t> nodes_but(std::size_t nodes, std::span<const std::size_t> fixed) {
  std::vector<bool> held(nodes, false);
  for (const std::size_t node : fixed) held[node] = true;
  std::vector<std::size_t> left;
  left.reserve(nodes);
  for (std::size_t node = 0; node < nodes; ++node) {
    if (!held[node]) left.push_back(node);
  }
  return left;
}

std::vector<std::size_t> places_in(const std::vector<std::size_t>& node_of, std::size_t nodes,
                                   std::size_t absent) {
  std::vector<std::size_t> places(nodes, absent);
  for (std::size_t v = 0; v < node_of.size(); ++v) places[node_of[v]] = v;
  return places;
}

}  // namespace

GraphPattern::GraphPattern(std::size_t nodes, std::span<const Edge> edges, std::span<const std::size_t> fixed)
    : node_of_(nodes_but(nodes, fixed)),
      variable_of_(places_in(node_of_, nodes, kFixed)),
      elimination_(node_of_.size(), variable_links(edges)) {
  places_.reserve(edges.size());
  for (const Edge& edge : edges) {
    EdgePlaces places;
    places.from_variable = variable_of_[edge.from];
    places.to_variable = variable_of_[edge.to];
    places.has_from = places.from_variable != kFixed;
    places.has_to = places.to_variable != kFixed;
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
    const std::size_t from = variable_of_[edge.from], to = variable_of_[edge.to];
    if (from != kFixed && to != kFixed) links.emplace_back(from, to);
  }
  return links;
}

}  // namespace topo::slam
