// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <span>

#include "core/types/transform.hpp"

namespace topo::slam {

/// The nodes whose loop search found no closure, with their poses at that time: an estimate that was outside
/// the search window, or too inaccurate to match, may succeed after a correction. Next to a node with a
/// closure another one adds no information. Which nodes are repeated depends only on the poses, not on when
/// they arrived.
class OpenQuestions {
 public:
  /// `moved_m`, `moved_rad`: a greater correction justifies a new search. Nodes less than `apart` from one
  /// with a closure are not repeated.
  OpenQuestions(double moved_m, double moved_rad, std::size_t apart)
      : moved_m_(moved_m), moved_rad_(moved_rad), apart_(apart) {}

  /// Records a search for a node at this pose.
  void ask(std::size_t node, const types::Se2& pose) { open_[node] = pose; }
  /// Records a closure of a node.
  void close(std::size_t node);
  /// Corrected poses of all nodes.
  void correct(std::span<const types::Se2> poses);
  /// The oldest node whose search is to be repeated; each is returned once. The caller then calls ask().
  std::optional<std::size_t> take();

 private:
  [[nodiscard]] bool is_beside_closed(std::size_t node) const;
  double moved_m_, moved_rad_;
  std::size_t apart_;
  std::map<std::size_t, types::Se2> open_;  ///< with the pose at the last search
  std::set<std::size_t> again_;
  std::set<std::size_t> closed_;
};

}  // namespace topo::slam
