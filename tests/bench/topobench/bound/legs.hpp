// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "tests/bench/topobench/bound/bound.hpp"

namespace topo::bench::bound {

/// Ways between the starts and the stops of one cover, and what is seen on them. Made when asked for.
class Legs {
 public:
  /// All are borrowed. Nodes are `starts` first, then `stops`.
  Legs(const WayMap& ways, const Sight& sight, std::vector<sim::Vector2> nodes, double look_m);

  [[nodiscard]] const Lengths& lengths() const { return lengths_; }
  [[nodiscard]] const Way& way(std::size_t from, std::size_t to);
  /// Seen from a node's place, and on the way between two.
  [[nodiscard]] const CellSet& seen_at(std::size_t node);
  [[nodiscard]] const CellSet& seen_on(std::size_t from, std::size_t to);
  /// From a start over its stops.
  [[nodiscard]] Way whole_way(std::size_t start, const std::vector<std::size_t>& stops);
  /// The same looks as seen_on() has, in the order of the way.
  [[nodiscard]] std::vector<Look> looks(std::size_t start, const std::vector<std::size_t>& stops);

 private:
  const WayMap& map_;
  const Sight& sight_;
  std::vector<sim::Vector2> nodes_;
  double look_m_;
  std::vector<WayMap::Field> fields_;
  Lengths lengths_;
  std::map<std::pair<std::size_t, std::size_t>, Way> ways_;
  std::map<std::pair<std::size_t, std::size_t>, CellSet> seen_on_;
  std::map<std::size_t, CellSet> seen_at_;
};

}  // namespace topo::bench::bound
