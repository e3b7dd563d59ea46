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

/// Which nodes were asked about and came out with no closure, and where they were then: an estimate that was
/// further off than the search reached, or fitted too badly to begin with, may do once it is corrected. Where
/// a neighbour on the way has a closure, another one says nothing new. What is asked again depends on the
/// poses alone, not on when they came.
class OpenQuestions {
 public:
  /// A correction of so much gives a question another answer.
  /// Nodes less than `apart` from one with a closure are not asked about.
  OpenQuestions(double moved_m, double moved_rad, std::size_t apart)
      : moved_m_(moved_m), moved_rad_(moved_rad), apart_(apart) {}

  /// A node was asked about at this pose.
  void ask(std::size_t node, const types::Se2& pose) { open_[node] = pose; }
  /// A closure was found.
  void close(std::size_t node);
  /// Poses of all nodes, corrected.
  void correct(std::span<const types::Se2> poses);
  /// The oldest node that is to be asked about again, once. ask() follows.
  std::optional<std::size_t> take();

 private:
  [[nodiscard]] bool is_beside_closed(std::size_t node) const;
  double moved_m_, moved_rad_;
  std::size_t apart_;
  std::map<std::size_t, types::Se2> open_;  ///< with the pose at which it was asked about
  std::set<std::size_t> again_;
  std::set<std::size_t> closed_;
};

}  // namespace topo::slam
