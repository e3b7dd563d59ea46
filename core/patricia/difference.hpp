// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>

#include "core/patricia/fold.hpp"
#include "core/patricia/node.hpp"

namespace topo::patricia::detail {

/// Walks two trees in parallel and skips common subtrees, which it recognises by pointer.
template <class V, class F>
class Differ {
 public:
  explicit Differ(F& f) : f_(f) {}

  void compare(NodeRef<V> a, NodeRef<V> b) {
    if (a == b) return;
    if (!b) {
      only_old(a);
    } else if (!a) {
      only_new(b);
    } else if (a.is_leaf() && b.is_leaf()) {
      compare_leaves(a, b);
    } else if (split_or_key(a) == split_or_key(b) && !a.is_leaf() && !b.is_leaf()) {
      compare(a.branch()->child[0], b.branch()->child[0]);
      compare(a.branch()->child[1], b.branch()->child[1]);
    } else if (is_above(a, b)) {
      const unsigned side = side_of(split_or_key(b), a.branch()->split);
      side == 0 ? compare(a.branch()->child[0], b) : only_old(a.branch()->child[0]);
      side == 0 ? only_old(a.branch()->child[1]) : compare(a.branch()->child[1], b);
    } else if (is_above(b, a)) {
      const unsigned side = side_of(split_or_key(a), b.branch()->split);
      side == 0 ? compare(a, b.branch()->child[0]) : only_new(b.branch()->child[0]);
      side == 0 ? only_new(b.branch()->child[1]) : compare(a, b.branch()->child[1]);
    } else {
      apart(a, b);
    }
  }

 private:
  static Key split_or_key(NodeRef<V> n) { return n.is_leaf() ? n.leaf()->key : n.branch()->split; }
  static Key height(NodeRef<V> n) { return n.is_leaf() ? 0 : parting_bit(n.branch()->split); }

  /// True when all keys of `low` belong below `high`.
  static bool is_above(NodeRef<V> high, NodeRef<V> low) {
    return height(high) > height(low) && belongs_below(split_or_key(low), high.branch()->split);
  }

  void compare_leaves(NodeRef<V> a, NodeRef<V> b) {
    if (a.leaf()->key != b.leaf()->key) {
      apart(a, b);
      return;
    }
    if constexpr (std::equality_comparable<V>) {
      if (a.leaf()->value == b.leaf()->value) return;
    }
    f_(a.leaf()->key, &a.leaf()->value, &b.leaf()->value);
  }

  /// Reports two trees without a common key, the smaller keys first.
  void apart(NodeRef<V> a, NodeRef<V> b) {
    const bool old_first = split_or_key(a) < split_or_key(b);
    if (old_first) only_old(a);
    only_new(b);
    if (!old_first) only_old(a);
  }

  void only_old(NodeRef<V> a) {
    auto report = [this](Key key, const V& value) { f_(key, &value, static_cast<const V*>(nullptr)); };
    fold(a, report);
  }
  void only_new(NodeRef<V> b) {
    auto report = [this](Key key, const V& value) { f_(key, static_cast<const V*>(nullptr), &value); };
    fold(b, report);
  }

  F& f_;
};

}  // namespace topo::patricia::detail
