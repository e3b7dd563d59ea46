// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// The map against a std::map under random sequences of changes.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/core/patricia/model.hpp"

namespace topo::patricia {
namespace {

using namespace testing;

/// A map, its model, and the versions taken on the way.
class Walk {
 public:
  void step() {
    const Key key = *any_key();
    const Bits value = *few_bits();
    switch (*rc::gen::inRange(0, 9)) {
      case 0:
      case 1:
        map_.insert_with(key, value, kUnion);
        model_[key] |= value;
        break;
      case 2:
        map_.insert_with(key, value, kSum);
        model_[key] += value;
        break;
      case 3:
        map_.insert(key, value);
        model_[key] = value;
        break;
      case 4:
        map_.update(key) += value;
        model_[key] += value;
        break;
      case 5:
        RC_ASSERT(map_.erase(key) == (model_.erase(key) == 1));
        break;
      case 6:
        versions_.emplace_back(map_, model_);
        break;
      case 7:
        exchange_with_other();
        break;
      default:
        drop_or_go_back(value);
    }
    check_find(key);
  }

  void check_all() const {
    RC_ASSERT(contents(map_) == model_);
    RC_ASSERT(contents(other_) == other_model_);
    for (const auto& [version, model] : versions_) RC_ASSERT(contents(version) == model);
  }

  void drop_versions_and_check_nodes() {
    versions_.clear();
    other_.clear();
    assert_only_nodes_of(arena_, model_.size());
    map_.clear();
    assert_only_nodes_of(arena_, 0);
  }

 private:
  void check_find(Key key) const {
    const Bits* found = map_.find(key);
    const auto expected = model_.find(key);
    RC_ASSERT((found == nullptr) == (expected == model_.end()));
    if (found != nullptr) RC_ASSERT(*found == expected->second);
    RC_ASSERT(map_.size() == model_.size());
    RC_ASSERT(map_.empty() == model_.empty());
  }

  /// Updates go on in another map of the same arena, which changes places with the first one.
  void exchange_with_other() {
    if (*rc::gen::arbitrary<bool>()) {
      map_.swap(other_);
    } else {
      BitMap held = std::move(map_);
      map_ = std::move(other_);
      other_ = std::move(held);
    }
    model_.swap(other_model_);
  }

  void drop_or_go_back(Bits choice) {
    if (versions_.empty()) return;
    const auto at = versions_.begin() + static_cast<std::ptrdiff_t>(choice % versions_.size());
    if (choice % 2 == 0) {
      map_ = at->first;
      model_ = at->second;
    } else {
      versions_.erase(at);
    }
  }

  BitArena arena_;
  BitMap map_{arena_};
  Model model_;
  BitMap other_{arena_};
  Model other_model_;
  std::vector<std::pair<BitMap, Model>> versions_;
};

TEST(Map, DoesWhatAStdMapDoesAndOldVersionsNeverChange) {
  EXPECT_TRUE(rc::check([] {
    Walk walk;
    const int steps = *rc::gen::inRange(1, 200);
    for (int i = 0; i < steps; ++i) walk.step();
    walk.check_all();
    walk.drop_versions_and_check_nodes();
  }));
}

TEST(Map, HasOneShapeForOneSetOfKeys) {
  EXPECT_TRUE(rc::check([] {
    BitArena arena;
    const Model model = *any_model();
    const auto extra = *rc::gen::container<std::vector<Key>>(any_key());
    std::vector<std::pair<Key, Bits>> shuffled(model.begin(), model.end());
    const auto seed = *rc::gen::arbitrary<std::uint64_t>();
    std::sort(shuffled.begin(), shuffled.end(), [seed](const auto& a, const auto& b) {
      return (a.first * (seed | 1U)) < (b.first * (seed | 1U));
    });

    const BitMap in_order = make_map(arena, model);
    BitMap with_detours(arena);
    for (const Key key : extra) with_detours.insert(key, 1);
    for (const auto& [key, value] : shuffled) with_detours.insert(key, value);
    for (const Key key : extra) {
      if (!model.contains(key)) with_detours.erase(key);
    }
    RC_ASSERT(shape(in_order) == shape(with_detours));
    RC_ASSERT(contents(with_detours) == model);
  }));
}

TEST(Map, FoldOverAWindowIsTheFilteredFold) {
  EXPECT_TRUE(rc::check([] {
    BitArena arena;
    const Model model = *any_model();
    const BitMap map = make_map(arena, model);
    const CellWindow window{*any_cell(), *any_cell()};  // sometimes empty
    std::vector<std::pair<Key, Bits>> expected;
    for (const auto& [key, value] : model) {
      if (window.contains(cell_of(key))) expected.emplace_back(key, value);
    }
    std::vector<std::pair<Key, Bits>> found;
    map.for_each_in(window, [&](Key key, Bits value) { found.emplace_back(key, value); });
    RC_ASSERT(found == expected);
  }));
}

TEST(Map, EmptyOneWithoutArenaCanBeReadAndAssigned) {
  BitArena arena;
  BitMap map;
  EXPECT_TRUE(map.empty());
  EXPECT_EQ(map.find(7), nullptr);
  EXPECT_FALSE(map.erase(7));
  map.clear();
  map.for_each([](Key, Bits) { FAIL(); });
  map.for_each_in({{-5, -5}, {5, 5}}, [](Key, Bits) { FAIL(); });
  BitMap other(arena);
  other.insert(7, 1);
  EXPECT_EQ(BitMap::merge(map, other, kUnion).size(), 1U);
  map = other;
  EXPECT_EQ(map.size(), 1U);
}

TEST(MapDeathTest, ChangingAMapWithoutArenaAborts) {
  BitMap map;
  EXPECT_DEATH(map.insert(1, 1), "without an arena");
}

}  // namespace
}  // namespace topo::patricia
