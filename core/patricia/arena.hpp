// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <utility>

#include "core/patricia/node.hpp"
#include "core/patricia/path.hpp"
#include "core/patricia/pool.hpp"
#include "core/types/invariant.hpp"

namespace topo::patricia {

namespace detail {
// Its address identifies the thread: comparing it costs one load, while std::this_thread::get_id() is a call.
inline thread_local char thread_mark = 0;
}  // namespace detail

/// Nodes alive in an arena.
struct ArenaCounts {
  std::size_t branches = 0;
  std::size_t leaves = 0;
  std::size_t bytes_reserved = 0;  ///< allocated from the system; grows with the peak, freed with the arena
};

/// Storage and owner thread of all nodes of a family of maps. Operations that build or free nodes (insert,
/// update, erase, merge, copying and destroying non-empty handles) run on the owner thread and abort on any
/// other, in every build: reference counts are not atomic. Must outlive its maps.
template <class V>
class Arena {
 public:
  Arena() = default;
  Arena(const Arena&) = delete;
  Arena& operator=(const Arena&) = delete;
  ~Arena() {
    types::require(branches_.live() == 0 && leaves_.live() == 0, "an arena was destroyed before its maps");
  }

  /// Makes the calling thread the owner. Only while no other thread uses the arena, and after a hand-over
  /// that orders the two threads: starting or joining a thread, or a release/acquire pair. (The thread that
  /// constructs an arena is its first owner.)
  void adopt() { owner_ = &detail::thread_mark; }

  void check_owner() const {
    types::require(owner_ == &detail::thread_mark,
                   "a thread that is not the arena's owner builds or frees nodes");
  }

  /// Owner thread.
  [[nodiscard]] ArenaCounts counts() const {
    return {branches_.live(), leaves_.live(), branches_.bytes_reserved() + leaves_.bytes_reserved()};
  }

  // For Map only. No owner check: Map checks once per call.

  [[nodiscard]] NodeRef<V> make_leaf(Key key, V value) {
    return NodeRef<V>(new (leaves_.allocate()) Leaf<V>{key, 1U, std::move(value)});
  }

  /// Takes over one reference to each child. `leaves`: number of keys below both.
  [[nodiscard]] NodeRef<V> make_branch(Key split, NodeRef<V> zero, NodeRef<V> one, std::uint32_t leaves) {
    return NodeRef<V>(new (branches_.allocate()) Branch<V>{split, {zero, one}, 1U, leaves});
  }
  [[nodiscard]] NodeRef<V> make_branch(Key split, NodeRef<V> zero, NodeRef<V> one) {
    return make_branch(split, zero, one, zero.size() + one.size());
  }

  /// Branch over two nodes at the highest bit in which their keys differ. Takes over both references.
  [[nodiscard]] NodeRef<V> join(Key key, NodeRef<V> node, Key other_key, NodeRef<V> other) {
    const Key split = split_of(key, other_key);
    return side_of(key, split) == 0 ? make_branch(split, node, other) : make_branch(split, other, node);
  }

  [[nodiscard]] static NodeRef<V> retain(NodeRef<V> node) {
    ++node.references();
    return node;
  }

  /// Drops one reference; the last one frees the subtree. Recursion is at most 64 deep: one level per key
  /// bit.
  void release(NodeRef<V> node) {
    if (node.is_leaf()) {
      release_leaf(node.leaf());
    } else {
      release_branch(node.branch());
    }
  }

  /// Path to the key that was updated last.
  [[nodiscard]] Path<V>& finger() { return finger_; }

 private:
  void release_leaf(Leaf<V>* leaf) {
    if (--leaf->references == 0) {
      leaf->~Leaf();
      leaves_.free(leaf);
    }
  }
  void release_branch(Branch<V>* branch) {
    if (--branch->references != 0) return;
    const NodeRef<V> zero = branch->child[0];
    const NodeRef<V> one = branch->child[1];
    branches_.free(branch);
    release(zero);
    release(one);
  }

  const char* owner_ = &detail::thread_mark;
  Pool<Branch<V>> branches_;
  Pool<Leaf<V>> leaves_;
  Path<V> finger_;

  static_assert(sizeof(Branch<V>) == 32, "two branches a cache line");
};

}  // namespace topo::patricia
