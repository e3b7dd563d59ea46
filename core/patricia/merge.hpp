// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>
#include <utility>

#include "core/patricia/arena.hpp"
#include "core/patricia/node.hpp"

namespace topo::patricia {

/// What Map::merge does with subtrees that both maps have in common.
enum class SharedSubtrees {
  kCombine,  ///< each value is combined with itself: correct for every combining function
  kKeep,     ///< kept unchanged, in O(1): correct when combine(v, v) == v
};

namespace detail {

/// Union of two trees (Okasaki and Gill, section 4). Results hold one reference for the caller. Inputs change
/// only in their reference counts.
template <class V, class Combine>
class Merger {
 public:
  Merger(Arena<V>& arena, Combine& combine, SharedSubtrees shared)
      : arena_(arena), combine_(combine), shared_(shared) {}

  NodeRef<V> merge(NodeRef<V> a, NodeRef<V> b) {
    if (a == b && shared_ == SharedSubtrees::kKeep) return Arena<V>::retain(a);
    if (a.is_leaf() && b.is_leaf()) return merge_leaves(a, b);
    if (b.is_leaf()) return merge_into(a, b, b.leaf()->key, 0U);
    if (a.is_leaf()) return merge_into(b, a, a.leaf()->key, 1U);
    return merge_branches(a, b);
  }

 private:
  NodeRef<V> merge_leaves(NodeRef<V> a, NodeRef<V> b) {
    const Key key_a = a.leaf()->key;
    const Key key_b = b.leaf()->key;
    if (key_a != key_b) return arena_.join(key_a, Arena<V>::retain(a), key_b, Arena<V>::retain(b));
    V value = combine_(std::as_const(a.leaf()->value), std::as_const(b.leaf()->value));
    if constexpr (std::equality_comparable<V>) {
      if (value == a.leaf()->value) return Arena<V>::retain(a);
      if (value == b.leaf()->value) return Arena<V>::retain(b);
    }
    return arena_.make_leaf(key_a, std::move(value));
  }

  NodeRef<V> merge_branches(NodeRef<V> a, NodeRef<V> b) {
    const Key split_a = a.branch()->split;
    const Key split_b = b.branch()->split;
    if (split_a == split_b) {
      const NodeRef<V> zero = merge(a.branch()->child[0], b.branch()->child[0]);
      const NodeRef<V> one = merge(a.branch()->child[1], b.branch()->child[1]);
      if (has_children(a, zero, one)) return reuse(a, zero, one);
      if (has_children(b, zero, one)) return reuse(b, zero, one);
      return arena_.make_branch(split_a, zero, one);
    }
    // Only the branch with the higher split bit can contain the other one.
    if (parting_bit(split_a) > parting_bit(split_b)) return merge_into(a, b, split_b, 0U);
    return merge_into(b, a, split_a, 1U);
  }

  /// `high` is a branch above or beside `low`; all of `low` lies on one side of its split. `high_is_b`
  /// preserves the argument order of combine.
  NodeRef<V> merge_into(NodeRef<V> high, NodeRef<V> low, Key low_key, unsigned high_is_b) {
    const Branch<V>* branch = high.branch();
    if (!belongs_below(low_key, branch->split)) {
      return arena_.join(branch->split, Arena<V>::retain(high), low_key, Arena<V>::retain(low));
    }
    const unsigned side = side_of(low_key, branch->split);
    const NodeRef<V> old_child = branch->child[side];
    const NodeRef<V> child = high_is_b != 0 ? merge(low, old_child) : merge(old_child, low);
    if (child == old_child) {
      arena_.release(child);
      return Arena<V>::retain(high);
    }
    const NodeRef<V> other = Arena<V>::retain(branch->child[1U - side]);
    return side == 0 ? arena_.make_branch(branch->split, child, other)
                     : arena_.make_branch(branch->split, other, child);
  }

  static bool has_children(NodeRef<V> node, NodeRef<V> zero, NodeRef<V> one) {
    return node.branch()->child[0] == zero && node.branch()->child[1] == one;
  }
  NodeRef<V> reuse(NodeRef<V> node, NodeRef<V> zero, NodeRef<V> one) {
    arena_.release(zero);
    arena_.release(one);
    return Arena<V>::retain(node);
  }

  Arena<V>& arena_;
  Combine& combine_;
  SharedSubtrees shared_;
};

}  // namespace detail
}  // namespace topo::patricia
