// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "core/patricia/cell_key.hpp"

namespace topo::patricia {

template <class V>
struct Branch;
template <class V>
struct Leaf;

/// Non-owning pointer to a branch or to a leaf (lowest bit set), or null.
template <class V>
class NodeRef {
 public:
  NodeRef() = default;
  explicit NodeRef(Branch<V>* b) : bits_(reinterpret_cast<std::uintptr_t>(b)) {}
  explicit NodeRef(Leaf<V>* l) : bits_(reinterpret_cast<std::uintptr_t>(l) | 1U) {}

  explicit operator bool() const { return bits_ != 0; }
  [[nodiscard]] bool is_leaf() const { return (bits_ & 1U) != 0; }
  // NOLINTBEGIN(performance-no-int-to-ptr): the lowest bit of the pointer says leaf or branch
  [[nodiscard]] Branch<V>* branch() const { return reinterpret_cast<Branch<V>*>(bits_); }
  [[nodiscard]] Leaf<V>* leaf() const { return reinterpret_cast<Leaf<V>*>(bits_ - 1U); }
  // NOLINTEND(performance-no-int-to-ptr)
  friend bool operator==(NodeRef, NodeRef) = default;

  [[nodiscard]] std::uint32_t& references() const;
  [[nodiscard]] std::uint32_t size() const;

 private:
  std::uintptr_t bits_ = 0;
};

/// Inner node at which two sets of keys diverge. 32 bytes: two fit in a cache line and none straddles two.
/// Threads that only read access `split`, `child` and `leaves`; `references` belongs to the owner thread.
template <class V>
struct Branch {
  Key split;            ///< common upper bits of all keys below, then a one at the split bit, then zeros
  NodeRef<V> child[2];  ///< indexed by the key's split bit; both are set
  std::uint32_t references;
  std::uint32_t leaves;  ///< number of keys below
};

/// One key with its value: 16 bytes for a 32-bit value.
template <class V>
struct Leaf {
  Key key;
  std::uint32_t references;
  V value;
};

template <class V>
std::uint32_t& NodeRef<V>::references() const {
  return is_leaf() ? leaf()->references : branch()->references;
}

template <class V>
std::uint32_t NodeRef<V>::size() const {
  if (bits_ == 0) return 0;
  return is_leaf() ? 1U : branch()->leaves;
}

/// Split bit of a branch: the lowest bit that is set.
constexpr Key parting_bit(Key split) { return split & (~split + 1U); }

/// Index of the child that a key belongs to, provided that the key belongs below the branch.
constexpr unsigned side_of(Key key, Key split) { return (key & parting_bit(split)) != 0 ? 1U : 0U; }

/// True when the key shares the branch's upper bits: all bits above the split bit.
constexpr bool belongs_below(Key key, Key split) {
  return ((key ^ split) & ~(parting_bit(split) | (parting_bit(split) - 1U))) == 0;
}

/// Split of the branch at which two different keys diverge.
constexpr Key split_of(Key a, Key b) {
  const Key highest = Key{1} << (63U - static_cast<unsigned>(__builtin_clzll(a ^ b)));
  return (a & ~(highest | (highest - 1U))) | highest;
}

/// First and last key that could be below a branch.
constexpr Key first_below(Key split) { return split & ~parting_bit(split); }
constexpr Key last_below(Key split) { return split | (parting_bit(split) - 1U); }

}  // namespace topo::patricia
