// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>
#include <cstddef>
#include <utility>

#include "core/patricia/arena.hpp"
#include "core/patricia/cell_key.hpp"
#include "core/patricia/difference.hpp"
#include "core/patricia/fold.hpp"
#include "core/patricia/merge.hpp"
#include "core/patricia/node.hpp"
#include "core/patricia/path.hpp"
#include "core/types/invariant.hpp"

namespace topo::patricia {

/// Persistent big-endian Patricia tree (Okasaki and Gill, "Fast mergeable integer maps", 1998): a handle to
/// one version of a map from keys to values. Copying the handle is O(1) and makes a snapshot: later changes
/// to either copy do not affect the other. The shape depends only on the set of keys, not on their insertion
/// order.
///
/// Threads: calls marked "owner" run on the thread that owns the arena. Other calls only read; they may run
/// on any thread while this version is kept alive (by a pinned sync::SnapshotCell value or a handle held by
/// the owner) and this handle itself is not changed. No call blocks or locks.
///
/// An update changes a node in place when only this handle reaches it, and copies it otherwise: a batch of
/// updates after a snapshot copies a node once. An update of a key near the one updated last, in the same map
/// and without a snapshot between, walks only the lowest few branches. References and pointers that find and
/// update return are valid until the handle is next changed.
///
/// For values with ==, an insertion that does not change the value changes and copies nothing, and difference
/// reports only values that differ.
template <class V>
class Map {
 public:
  /// Empty and without an arena: can be read and assigned to.
  Map() = default;
  explicit Map(Arena<V>& arena) : arena_(&arena) {}

  /// Owner (an empty map: any thread). O(1).
  Map(const Map& other) : arena_(other.arena_), root_(other.root_) {
    if (root_) {
      arena_->check_owner();
      arena_->finger().forget();
      (void)Arena<V>::retain(root_);
    }
  }
  Map(Map&& other) noexcept : arena_(other.arena_), root_(std::exchange(other.root_, NodeRef<V>())) {}
  Map& operator=(const Map& other) {
    if (this != &other) Map(other).swap(*this);
    return *this;
  }
  Map& operator=(Map&& other) noexcept {
    Map(std::move(other)).swap(*this);
    return *this;
  }
  /// Owner (an empty map: any thread). Linear in the nodes that only this version has.
  ~Map() { clear(); }

  void swap(Map& other) noexcept {
    std::swap(arena_, other.arena_);
    std::swap(root_, other.root_);
  }

  [[nodiscard]] Arena<V>* arena() const { return arena_; }

  /// Any thread. O(1).
  [[nodiscard]] std::size_t size() const { return root_.size(); }
  [[nodiscard]] bool empty() const { return !root_; }

  /// Any thread. Null when the key is absent.
  [[nodiscard]] const V* find(Key key) const {
    if (!root_) return nullptr;
    NodeRef<V> node = root_;
    while (!node.is_leaf()) {
      // Only the leaf's key is compared; the branches on the path are not checked against the key.
      const Branch<V>* branch = node.branch();
      node = branch->child[side_of(key, branch->split)];
    }
    const Leaf<V>* leaf = node.leaf();
    return leaf->key == key ? &leaf->value : nullptr;
  }

  /// Owner. Stores `value` under a new key, or replaces the present value with combine(present, value).
  template <class Combine>
  requires std::invocable<Combine&, const V&, const V&>
  void insert_with(Key key, V value, Combine combine) {
    writable().check_owner();
    if (!root_) {
      root_ = arena_->make_leaf(key, std::move(value));
      return;
    }
    Path<V>& path = arena_->finger();
    path.seek(root_, key);
    if (!path.found()) {
      add_leaf(path, key, std::move(value));
      return;
    }
    V combined = combine(std::as_const(path.end().leaf()->value), std::as_const(value));
    if constexpr (std::equality_comparable<V>) {
      if (combined == path.end().leaf()->value) return;
    }
    replace_value(path, std::move(combined));
  }

  /// Owner. Stores `value` under the key and replaces any present value.
  void insert(Key key, V value) {
    insert_with(key, std::move(value), [](const V&, const V& given) { return given; });
  }

  /// Owner. Returns the value under the key, to be changed in place; value-initialised when the key was
  /// absent. No other version shares it. The reference is valid until this handle is next changed or copied.
  [[nodiscard]] V& update(Key key) {
    writable().check_owner();
    if (!root_) {
      root_ = arena_->make_leaf(key, V{});
      return root_.leaf()->value;
    }
    Path<V>& path = arena_->finger();
    path.seek(root_, key);
    if (!path.found()) return add_leaf(path, key, V{});
    if (!path.end_shared()) return path.end().leaf()->value;
    return replace_value(path, V(path.end().leaf()->value));
  }

  /// Owner. True when the key was present.
  bool erase(Key key) {
    if (!root_) return false;
    arena_->check_owner();
    Path<V>& path = arena_->finger();
    path.seek(root_, key);
    if (!path.found()) return false;
    if (path.depth() == 0) {
      clear();
    } else {
      remove_leaf(path);
    }
    return true;
  }

  /// Owner (an empty map: any thread).
  void clear() {
    if (!root_) return;
    arena_->check_owner();
    arena_->finger().forget();
    arena_->release(std::exchange(root_, NodeRef<V>()));
  }

  /// Any thread. Calls f(Key, const V&) for all keys in ascending order.
  template <class F>
  void for_each(F&& f) const {
    if (root_) detail::fold(root_, f);
  }

  /// Any thread. Calls f(Key, const V&) for the keys whose cells lie in the window, in ascending order.
  /// Subtrees outside the window are skipped, subtrees inside are walked without a test.
  template <class F>
  void for_each_in(const CellWindow& window, F&& f) const {
    if (root_ && !window.empty()) detail::fold_window(root_, detail::KeyWindow(window), f);
  }

  /// Owner. Union of two maps of one arena (or empty ones); the value is combine(a's value, b's value) where
  /// both have the key. Subtrees that only one map has are shared, not copied. When the result equals one of
  /// the maps, it is that version.
  ///
  /// `shared` selects the treatment of subtrees that a and b have in common (versions of one map). kCombine
  /// combines each value with itself, which is correct for every combine. kKeep keeps them in O(1), which is
  /// correct when combine(v, v) == v (union of bits, maximum, newest) and makes the cost that of the
  /// difference.
  template <class Combine>
  requires std::invocable<Combine&, const V&, const V&>
  [[nodiscard]] static Map merge(const Map& a, const Map& b, Combine combine,
                                 SharedSubtrees shared = SharedSubtrees::kCombine) {
    if (!b.root_) return a;
    if (!a.root_) return b;
    types::require(a.arena_ == b.arena_, "maps of two arenas cannot be merged");
    a.arena_->check_owner();
    a.arena_->finger().forget();
    Map result(*a.arena_);
    result.root_ = detail::Merger<V, Combine>(*a.arena_, combine, shared).merge(a.root_, b.root_);
    return result;
  }

  /// Any thread. Calls f(Key, const V* old_value, const V* new_value), in ascending order, for every key
  /// whose value differs; null where a version has no such key. When one version was made from the other, the
  /// cost is that of their difference.
  template <class F>
  static void difference(const Map& old_map, const Map& new_map, F&& f) {
    detail::Differ<V, F>(f).compare(old_map.root_, new_map.root_);
  }

  /// Any thread. Root of the tree, for code that inspects its structure. Empty when there is no key.
  [[nodiscard]] NodeRef<V> root() const { return root_; }

  /// Any thread. True when both are the same version. O(1); may be false for equal contents.
  [[nodiscard]] bool same_version(const Map& other) const { return root_ == other.root_; }

 private:
  Arena<V>& writable() const {
    types::require(arena_ != nullptr, "a map without an arena was changed");
    return *arena_;
  }

  V& add_leaf(Path<V>& path, Key key, V value) {
    path.make_exclusive(*arena_, path.depth());
    const NodeRef<V> end = path.end();
    const Key other_key = end.is_leaf() ? end.leaf()->key : end.branch()->split;
    const NodeRef<V> leaf = arena_->make_leaf(key, std::move(value));
    path.set_link(path.depth(), arena_->join(key, leaf, other_key, end));
    path.add_to_counts(path.depth(), 1U);
    return leaf.leaf()->value;
  }

  V& replace_value(Path<V>& path, V value) {
    if (!path.end_shared()) {
      V& present = path.end().leaf()->value;
      present = std::move(value);
      return present;
    }
    path.make_exclusive(*arena_, path.depth());
    const NodeRef<V> old = path.end();
    const NodeRef<V> leaf = arena_->make_leaf(old.leaf()->key, std::move(value));
    path.set_link(path.depth(), leaf);
    arena_->release(old);
    return leaf.leaf()->value;
  }

  // Removes the branch above the leaf as well; the leaf's sibling replaces that branch.
  void remove_leaf(Path<V>& path) {
    const unsigned parent_level = path.depth() - 1;
    path.make_exclusive(*arena_, parent_level);
    Branch<V>* parent = path.branch(parent_level);
    const NodeRef<V> sibling = parent->child[1U - path.side(parent_level)];
    path.set_link(parent_level, Arena<V>::retain(sibling));
    arena_->release(NodeRef<V>(parent));
    path.add_to_counts(parent_level, ~std::uint32_t{0});
    path.forget();
  }

  Arena<V>* arena_ = nullptr;
  NodeRef<V> root_;
};

}  // namespace topo::patricia
