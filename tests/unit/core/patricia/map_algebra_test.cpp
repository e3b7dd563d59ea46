// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// Laws of union and difference.
#include <gtest/gtest.h>

#include "tests/unit/core/patricia/model.hpp"

namespace topo::patricia {
namespace {

using namespace testing;

template <class Combine>
Model merge_models(Model a, const Model& b, Combine combine) {
  for (const auto& [key, value] : b) {
    const auto [at, is_new] = a.emplace(key, value);
    if (!is_new) at->second = combine(at->second, value);
  }
  return a;
}

/// Two maps of which one may have been made from the other, so that they share subtrees.
std::pair<BitMap, BitMap> related_pair(BitArena& arena) {
  BitMap a = make_map(arena, *any_model());
  BitMap b = *rc::gen::arbitrary<bool>() ? a : BitMap(arena);
  for (const auto& [key, value] : *any_model()) b.insert_with(key, value, kSum);
  for (const Key key : *rc::gen::container<std::vector<Key>>(any_key())) b.erase(key);
  for (const Key key : *rc::gen::container<std::vector<Key>>(any_key())) a.erase(key);
  return {std::move(a), std::move(b)};
}

TEST(Merge, IsTheModelsUnionWithTheCombiningFunctionsOrder) {
  EXPECT_TRUE(rc::check([] {
    BitArena arena;
    const auto [a, b] = related_pair(arena);
    const Model model_a = contents(a);
    const Model model_b = contents(b);
    RC_ASSERT(contents(BitMap::merge(a, b, kSum)) == merge_models(model_a, model_b, kSum));
    RC_ASSERT(contents(BitMap::merge(a, b, kFirst)) == merge_models(model_a, model_b, kFirst));
    RC_ASSERT(contents(BitMap::merge(a, b, kUnion, SharedSubtrees::kKeep)) ==
              merge_models(model_a, model_b, kUnion));
    RC_ASSERT(contents(a) == model_a);
    RC_ASSERT(contents(b) == model_b);
  }));
}

TEST(Merge, IsCommutativeAndAssociativeAndHasTheOneShape) {
  EXPECT_TRUE(rc::check([] {
    BitArena arena;
    const auto [a, b] = related_pair(arena);
    const BitMap c = make_map(arena, *any_model());
    for (const auto shared : {SharedSubtrees::kCombine, SharedSubtrees::kKeep}) {
      const auto merge = [shared](const BitMap& x, const BitMap& y) {
        return BitMap::merge(x, y, kUnion, shared);
      };
      const BitMap left = merge(merge(a, b), c);
      const BitMap right = merge(a, merge(b, c));
      RC_ASSERT(contents(merge(a, b)) == contents(merge(b, a)));
      RC_ASSERT(contents(left) == contents(right));
      RC_ASSERT(shape(left) == shape(right));
      RC_ASSERT(shape(left) == shape(make_map(arena, contents(left))));
    }
  }));
}

TEST(Merge, IsIdempotentAbsorbsAndKeepsEqualSides) {
  EXPECT_TRUE(rc::check([] {
    BitArena arena;
    const auto [a, b] = related_pair(arena);
    for (const auto shared : {SharedSubtrees::kCombine, SharedSubtrees::kKeep}) {
      RC_ASSERT(BitMap::merge(a, a, kUnion, shared).same_version(a));
      const BitMap both = BitMap::merge(a, b, kUnion, shared);
      RC_ASSERT(BitMap::merge(both, b, kUnion, shared).same_version(both));
      RC_ASSERT(BitMap::merge(a, both, kUnion, shared).same_version(both));
    }
  }));
}

TEST(Merge, LeavesNoNodeBehind) {
  EXPECT_TRUE(rc::check([] {
    BitArena arena;
    {
      const auto [a, b] = related_pair(arena);
      BitMap both = BitMap::merge(a, b, kSum);
      both.update(*any_key()) = 3;
    }
    assert_only_nodes_of(arena, 0);
  }));
}

struct Change {
  bool had = false;
  bool has = false;
  Bits old_value = 0;
  Bits new_value = 0;
};

std::map<Key, Change> changes(const BitMap& from, const BitMap& to) {
  std::map<Key, Change> result;
  Key previous = 0;
  BitMap::difference(from, to, [&](Key key, const Bits* old_value, const Bits* new_value) {
    RC_ASSERT(result.empty() || previous < key);
    previous = key;
    Change& c = result[key];
    if ((c.had = old_value != nullptr)) c.old_value = *old_value;
    if ((c.has = new_value != nullptr)) c.new_value = *new_value;
  });
  return result;
}

TEST(Difference, NamesExactlyWhatIsNotTheSame) {
  EXPECT_TRUE(rc::check([] {
    BitArena arena;
    const auto [a, b] = related_pair(arena);
    const Model model_a = contents(a);
    const Model model_b = contents(b);
    const auto found = changes(a, b);
    for (const auto& [key, c] : found) {
      RC_ASSERT(c.had == model_a.contains(key));
      RC_ASSERT(c.has == model_b.contains(key));
      RC_ASSERT(c.had != c.has || c.old_value != c.new_value);
      if (c.had) RC_ASSERT(c.old_value == model_a.at(key));
      if (c.has) RC_ASSERT(c.new_value == model_b.at(key));
    }
    for (const auto& [key, value] : model_a) {
      const auto at = model_b.find(key);
      RC_ASSERT(found.contains(key) == (at == model_b.end() || at->second != value));
    }
    for (const auto& [key, value] : model_b) RC_ASSERT(model_a.contains(key) || found.contains(key));
    RC_ASSERT(changes(a, a).empty());
  }));
}

TEST(Difference, IsUndoneByAPatch) {
  EXPECT_TRUE(rc::check([] {
    BitArena arena;
    const auto [a, b] = related_pair(arena);
    BitMap patched = a;
    for (const auto& [key, c] : changes(a, b)) {
      if (c.has) {
        patched.insert(key, c.new_value);
      } else {
        patched.erase(key);
      }
    }
    RC_ASSERT(contents(patched) == contents(b));
    RC_ASSERT(shape(patched) == shape(b));
    RC_ASSERT(changes(patched, b).empty());
  }));
}

}  // namespace
}  // namespace topo::patricia
