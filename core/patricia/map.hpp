// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>
#include <cstddef>
#include <utility>

#include "core/patricia/arena.hpp"
#include "core/patricia/cell_key.hpp"
#include "core/patricia/check.hpp"
#include "core/patricia/difference.hpp"
#include "core/patricia/fold.hpp"
#include "core/patricia/merge.hpp"
#include "core/patricia/node.hpp"
#include "core/patricia/path.hpp"

namespace topo::patricia {

/// Persistent big-endian Patricia tree (Okasaki and Gill, "Fast mergeable integer maps", 1998): a handle to
/// one version of a map from keys to values. Copying the handle is O(1) and is a snapshot: later changes to
/// either copy do not show in the other. One set of keys has one shape, whatever the order in which they
/// came.
///
/// Threads: "owner" below is the thread that owns the arena; other calls only read and may run on any
/// thread while somebody keeps this version alive (a pinned sync::SnapshotCell value, a handle held by the
/// owner) and nobody changes this very handle. Nothing blocks or locks.
///
/// Updates change a node in place when only this handle reaches it, and copy it otherwise: a batch of updates
/// after a snapshot copies a node once. An update of a key near the one updated last, in the same map and
/// without a snapshot between, walks only the lowest few branches. References and pointers that find and
/// update give out are good until the handle is next changed.
///
/// When values can be compared (==), an update that leaves its value as it was changes and copies nothing,
/// and difference reports real differences only.
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
  /// Owner (an empty map: any thread). Costs the nodes that only this version has.
  ~Map() { clear(); }

  void swap(Map& other) noexcept {
    std::swap(arena_, other.arena_);
    std::swap(root_, other.root_);
  }

  [[nodiscard]] Arena<V>* arena() const { return arena_; }

  /// Any thread. O(1).
  [[nodiscard]] std::size_t size() const { return root_.size(); }
  [[nodiscard]] bool empty() const { return !root_; }

  /// Any thread. Null when the key is not there.
  [[nodiscard]] const V* find(Key key) const {
    if (!root_) return nullptr;
    NodeRef<V> node = root_;
    while (!node.is_leaf()) {
      // Whether the key fits the branch is not asked on the way: the leaf tells.
      const Branch<V>* branch = node.branch();
      node = branch->child[side_of(key, branch->split)];
    }
    const Leaf<V>* leaf = node.leaf();
    return leaf->key == key ? &leaf->value : nullptr;
  }

  /// Owner. Puts `value` under a new key, or combine(present, value) in place of the present value.
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

  /// Owner. Puts `value` under the key, in place of what was there.
  void insert(Key key, V value) {
    insert_with(key, std::move(value), [](const V&, const V& given) { return given; });
  }

  /// Owner. The value under the key, value-initialised when it was not there, to be changed in place: no
  /// other version has it any more. The reference is good until this handle is next changed or copied.
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

  /// Owner. True when the key was there.
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

  /// Any thread. f(Key, const V&) for all, in ascending order of keys.
  template <class F>
  void for_each(F&& f) const {
    if (root_) detail::fold(root_, f);
  }

  /// Any thread. f(Key, const V&) for the keys whose cells lie in the window, in ascending order of keys.
  /// Subtrees outside are skipped whole, those inside are walked without a test.
  template <class F>
  void for_each_in(const CellWindow& window, F&& f) const {
    if (root_ && !window.empty()) detail::fold_window(root_, detail::KeyWindow(window), f);
  }

  /// Owner of both, which are of one arena (or empty). All keys of both; combine(a's value, b's value) where
  /// both have one. Subtrees that only one has are shared, not copied, and a side that the result equals is
  /// given back itself.
  ///
  /// `shared` decides what becomes of subtrees that a and b have in common (versions of one map): kCombine
  /// combines each of their values with itself, which is right for every combine; kKeep takes them as they
  /// are, in O(1), which is right when combine(v, v) == v (union of bits, maximum, newest) and makes the cost
  /// that of the difference.
  template <class Combine>
  requires std::invocable<Combine&, const V&, const V&>
  [[nodiscard]] static Map merge(const Map& a, const Map& b, Combine combine,
                                 SharedSubtrees shared = SharedSubtrees::kCombine) {
    if (!b.root_) return a;
    if (!a.root_) return b;
    check(a.arena_ == b.arena_, "maps of two arenas cannot be merged");
    a.arena_->check_owner();
    a.arena_->finger().forget();
    Map result(*a.arena_);
    result.root_ = detail::Merger<V, Combine>(*a.arena_, combine, shared).merge(a.root_, b.root_);
    return result;
  }

  /// Any thread. f(Key, const V* old_value, const V* new_value), ascending, for every key whose value is not
  /// the same; null where a version has no such key. Costs as much as the versions differ when one was made
  /// from the other.
  template <class F>
  static void difference(const Map& old_map, const Map& new_map, F&& f) {
    detail::Differ<V, F>(f).compare(old_map.root_, new_map.root_);
  }

  /// Any thread. The tree itself, for what looks at its form. Empty when there is no key.
  [[nodiscard]] NodeRef<V> root() const { return root_; }

  /// Any thread. True when both are the very same version: O(1), and may be false for equal contents.
  [[nodiscard]] bool same_version(const Map& other) const { return root_ == other.root_; }

 private:
  Arena<V>& writable() const {
    check(arena_ != nullptr, "a map without an arena was changed");
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

  // The branch above the leaf goes too; the leaf's sibling takes its place.
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
