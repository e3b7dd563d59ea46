// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "core/patricia/node.hpp"
#include "core/types/invariant.hpp"

namespace topo::patricia {

/// Path from a root towards a key: the nodes that an update changes. Records the level from which nodes are
/// reachable from another version too. Such a node is copied before it changes; a node that only this path
/// reaches is changed in place. A batch of updates therefore copies a node once, and a version that is still
/// held never changes.
///
/// An arena keeps one path as a finger: the next key is mostly near the last one, and then only the lowest
/// few branches are walked again. Operations that change reference counts or structure without the path
/// (copying and destroying handles, erase, merge) must call forget().
template <class V>
class Path {
 public:
  Path() = default;
  ~Path() = default;
  Path(const Path&) = delete;
  Path& operator=(const Path&) = delete;

  void forget() { root_ = nullptr; }

  /// Descends from `root` (not empty) while the key belongs below the branch; stops at a leaf or at a branch
  /// that the key does not belong below.
  void seek(NodeRef<V>& root, Key key) {
    if (root_ == &root && root_seen_ == root) {
      rewind(key ^ key_);
    } else {
      root_ = &root;
      root_seen_ = root;
      depth_ = 0;
      first_shared_ = kNothingShared;
    }
    key_ = key;
    descend();
  }

  [[nodiscard]] NodeRef<V> end() const { return end_; }
  [[nodiscard]] unsigned depth() const { return depth_; }
  [[nodiscard]] Branch<V>* branch(unsigned level) const { return steps_[level].branch; }
  [[nodiscard]] unsigned side(unsigned level) const { return steps_[level].side; }

  /// True when the end is the key's leaf.
  [[nodiscard]] bool found() const { return end_.is_leaf() && end_.leaf()->key == key_; }

  /// Replaces the node at `level`; level depth() is the end.
  void set_link(unsigned level, NodeRef<V> node) {
    if (level == 0) {
      *root_ = node;
      root_seen_ = node;
    } else {
      steps_[level - 1].branch->child[steps_[level - 1].side] = node;
    }
  }

  /// True when the end is reachable from another version.
  [[nodiscard]] bool end_shared() const { return first_shared_ <= depth_ || end_.references() != 1U; }

  /// Copies the shared ones among the first `levels` branches, so that their links may be written.
  template <class Arena>
  void make_exclusive(Arena& arena, unsigned levels) {
    for (unsigned level = first_shared_; level < levels; ++level) {
      Branch<V>* old = steps_[level].branch;
      // The copy holds a reference to each child. The old branch loses the reference from the link above,
      // which is not its last one: it is shared, or was reachable from a shared branch.
      const NodeRef<V> copy = arena.make_branch(old->split, Arena::retain(old->child[0]),
                                                Arena::retain(old->child[1]), old->leaves);
      --old->references;
      set_link(level, copy);
      steps_[level].branch = copy.branch();
    }
    if (first_shared_ < levels) first_shared_ = levels;
  }

  /// Corrects the key counts of the first `levels` branches after a key below was added (1) or removed (-1).
  void add_to_counts(unsigned levels, std::uint32_t delta) {
    for (unsigned level = 0; level < levels; ++level) steps_[level].branch->leaves += delta;
  }

 private:
  struct Step {
    Branch<V>* branch;
    unsigned side;
  };
  static constexpr unsigned kNothingShared = 65;

  /// Shortens the path to the part that it shares with a key that differs from the last one in the bits of
  /// `difference`.
  void rewind(Key difference) {
    while (depth_ > 0 && parting_bit(steps_[depth_ - 1].branch->split) <= difference) --depth_;
    if (first_shared_ >= depth_) first_shared_ = kNothingShared;
  }

  void descend() {
    NodeRef<V> node = depth_ == 0 ? *root_ : steps_[depth_ - 1].branch->child[steps_[depth_ - 1].side];
    while (!node.is_leaf()) {
      Branch<V>* branch = node.branch();
      if (branch->references != 1U && first_shared_ > depth_) first_shared_ = depth_;
      if (!belongs_below(key_, branch->split)) break;
      const unsigned side = side_of(key_, branch->split);
      types::require(depth_ < steps_.size(), "a path has more branches than its key has bits");
      steps_[depth_++] = {branch, side};
      node = branch->child[side];
    }
    end_ = node;
  }

  NodeRef<V>* root_ = nullptr;  ///< the handle's root; null: no path is recorded
  NodeRef<V> root_seen_;        ///< its last value; the handle may have been assigned another tree since
  NodeRef<V> end_;
  Key key_ = 0;
  unsigned depth_ = 0;
  unsigned first_shared_ = kNothingShared;
  std::array<Step, 64> steps_{};  ///< at most one per key bit
};

}  // namespace topo::patricia
