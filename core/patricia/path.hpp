// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "core/patricia/arena.hpp"
#include "core/patricia/node.hpp"

namespace topo::patricia {

/// Way from a root towards a key: what an update changes. Remembers from where on nodes are reachable from
/// another version too: such a node is copied before it changes, one that only this path reaches is changed
/// in place. So a batch copies a node once, and a version that somebody holds never changes.
template <class V>
class Path {
 public:
  /// Goes down as far as branches fit the key; stops at a leaf or at a branch to which the key does not
  /// belong.
  Path(NodeRef<V>& root, Key key) : root_(root) {
    NodeRef<V> node = root;
    while (!node.is_leaf()) {
      Branch<V>* branch = node.branch();
      if (branch->references != 1U && first_shared_ > depth_) first_shared_ = depth_;
      if (!belongs_below(key, branch->split)) break;
      const unsigned side = side_of(key, branch->split);
      steps_[depth_++] = {branch, side};
      node = branch->child[side];
    }
    end_ = node;
  }
  ~Path() = default;
  Path(const Path&) = delete;
  Path& operator=(const Path&) = delete;

  [[nodiscard]] NodeRef<V> end() const { return end_; }
  [[nodiscard]] unsigned depth() const { return depth_; }
  [[nodiscard]] Branch<V>* branch(unsigned level) const { return steps_[level].branch; }
  [[nodiscard]] unsigned side(unsigned level) const { return steps_[level].side; }

  /// Where the pointer to the node at `level` is stored; `depth()` is the end's.
  [[nodiscard]] NodeRef<V>& link(unsigned level) {
    return level == 0 ? root_ : steps_[level - 1].branch->child[steps_[level - 1].side];
  }

  /// True when another version reaches the branch at `level`.
  [[nodiscard]] bool shared(unsigned level) const { return first_shared_ <= level; }

  /// True when another version reaches the end.
  [[nodiscard]] bool end_shared() const { return shared(depth_) || end_.references() != 1U; }

  /// Copies what is shared of the first `levels` branches, so that their links may be written.
  void make_exclusive(Arena<V>& arena, unsigned levels) {
    for (unsigned level = first_shared_; level < levels; ++level) {
      Branch<V>* old = steps_[level].branch;
      // The copy has a reference to each child; the old branch loses the one from the link above, and as it
      // is shared, or reachable from a branch that is, it does not lose its last one.
      const NodeRef<V> copy =
          arena.make_branch(old->split, Arena<V>::retain(old->child[0]), Arena<V>::retain(old->child[1]));
      --old->references;
      link(level) = copy;
      steps_[level].branch = copy.branch();
    }
    if (first_shared_ < levels) first_shared_ = levels;
  }

  /// After a key was added (1) or taken (-1) below: corrects the counts of the first `levels` branches.
  void add_to_counts(unsigned levels, std::uint32_t delta) {
    for (unsigned level = 0; level < levels; ++level) steps_[level].branch->leaves += delta;
  }

 private:
  struct Step {
    Branch<V>* branch;
    unsigned side;
  };
  static constexpr unsigned kNothingShared = 65;

  NodeRef<V>& root_;
  NodeRef<V> end_;
  unsigned depth_ = 0;
  unsigned first_shared_ = kNothingShared;
  std::array<Step, 64> steps_;  // one a key bit at most; not initialised
};

}  // namespace topo::patricia
