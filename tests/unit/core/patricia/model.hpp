// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <rapidcheck.h>

#include <cstdint>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "core/patricia/map.hpp"

namespace topo::patricia::testing {

using Bits = std::uint32_t;
using BitArena = Arena<Bits>;
using BitMap = Map<Bits>;
using Model = std::map<Key, Bits>;

inline constexpr auto kUnion = [](const Bits& a, const Bits& b) { return a | b; };
inline constexpr auto kSum = [](const Bits& a, const Bits& b) { return a + b; };
inline constexpr auto kFirst = [](const Bits& a, const Bits&) { return a; };

/// Coordinates near each other and around zero, so that keys meet, and any others, so that trees get deep.
inline rc::Gen<std::int32_t> coordinate() {
  return rc::gen::weightedOneOf<std::int32_t>(
      {{8, rc::gen::inRange<std::int32_t>(-6, 7)},
       {1, rc::gen::element<std::int32_t>(std::numeric_limits<std::int32_t>::min(),
                                          std::numeric_limits<std::int32_t>::max())},
       {1, rc::gen::arbitrary<std::int32_t>()}});
}
inline rc::Gen<Cell> any_cell() { return rc::gen::construct<Cell>(coordinate(), coordinate()); }
inline rc::Gen<Key> any_key() {
  return rc::gen::map(any_cell(), [](Cell c) { return cell_key(c); });
}
inline rc::Gen<Bits> few_bits() { return rc::gen::inRange<Bits>(0, 16); }
inline rc::Gen<Model> any_model() { return rc::gen::container<Model>(any_key(), few_bits()); }

inline BitMap make_map(BitArena& arena, const Model& model) {
  BitMap map(arena);
  for (const auto& [key, value] : model) map.insert(key, value);
  return map;
}

template <class V>
std::map<Key, V> contents(const Map<V>& map) {
  std::map<Key, V> result;
  Key previous = 0;
  bool first = true;
  map.for_each([&](Key key, const V& value) {
    RC_ASSERT(first || previous < key);
    first = false;
    previous = key;
    result.emplace(key, value);
  });
  RC_ASSERT(result.size() == map.size());
  return result;
}

/// The tree's form written down: every branch's split and every leaf's key, in order.
inline void write_shape(NodeRef<Bits> node, std::vector<Key>& out) {
  if (!node) return;
  if (node.is_leaf()) {
    out.push_back(node.leaf()->key);
    return;
  }
  const Branch<Bits>* branch = node.branch();
  RC_ASSERT(branch->leaves == branch->child[0].size() + branch->child[1].size());
  out.push_back(branch->split);
  write_shape(branch->child[0], out);
  write_shape(branch->child[1], out);
}
inline std::vector<Key> shape(const BitMap& map) {
  std::vector<Key> result;
  write_shape(map.root(), result);
  return result;
}

/// Nodes that n keys need in one version.
inline void assert_only_nodes_of(const BitArena& arena, std::size_t n) {
  RC_ASSERT(arena.counts().leaves == n);
  RC_ASSERT(arena.counts().branches == (n == 0 ? 0 : n - 1));
}

}  // namespace topo::patricia::testing
