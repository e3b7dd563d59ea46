// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/patricia/cell_key.hpp"
#include "core/patricia/node.hpp"

namespace topo::patricia::detail {

// All of these recurse at most 64 deep: one level per key bit.

template <class V, class F>
void fold(NodeRef<V> node, F& f) {
  while (!node.is_leaf()) {
    const Branch<V>* branch = node.branch();
    fold(branch->child[0], f);
    node = branch->child[1];
  }
  const Leaf<V>* leaf = node.leaf();
  f(leaf->key, leaf->value);
}

/// Window of cells as two keys. Comparisons mask x and y, so that keys are not decoded.
class KeyWindow {
 public:
  explicit KeyWindow(const CellWindow& w) : min_(cell_key(w.min)), max_(cell_key(w.max)) {}

  [[nodiscard]] bool contains(Key key) const { return overlaps(key, key); }

  /// True when the block of cells from key `first` to `last` intersects the window.
  [[nodiscard]] bool overlaps(Key first, Key last) const {
    return x(first) <= x(max_) && y(first) <= y(max_) && x(last) >= x(min_) && y(last) >= y(min_);
  }
  [[nodiscard]] bool covers(Key first, Key last) const { return contains(first) && contains(last); }

 private:
  static Key x(Key key) { return key & kKeyBitsX; }
  static Key y(Key key) { return key & kKeyBitsY; }
  Key min_;
  Key max_;
};

template <class V, class F>
void fold_window(NodeRef<V> node, const KeyWindow& window, F& f) {
  while (!node.is_leaf()) {
    const Branch<V>* branch = node.branch();
    const Key first = first_below(branch->split);
    const Key last = last_below(branch->split);
    if (!window.overlaps(first, last)) return;
    if (window.covers(first, last)) {
      fold(node, f);
      return;
    }
    fold_window(branch->child[0], window, f);
    node = branch->child[1];
  }
  const Leaf<V>* leaf = node.leaf();
  if (window.contains(leaf->key)) f(leaf->key, leaf->value);
}

}  // namespace topo::patricia::detail
