// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/segmentation/regions.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <map>
#include <utility>

#include "core/grid/clearance_update.hpp"
#include "tests/unit/core/places/drawn_map.hpp"
#include "tests/unit/core/places/patches.hpp"

namespace topo::places {
namespace {

using grid::DenseMap;

const FirstLabelParams kFirstLabels{0.4};

void check_box(const types::Rectangle& a, const types::Rectangle& b) {
  RC_ASSERT(a.min == b.min && a.max == b.max);
}

/// Along the map's axes, somewhere in it.
std::vector<types::Segment> draw_walls(const DenseMap& map) {
  std::vector<types::Segment> walls;
  for (int k = *rc::gen::inRange(0, 4); k > 0; --k) {
    const types::Vector2 a =
        map.centre_of({*rc::gen::inRange(0, map.width()), *rc::gen::inRange(0, map.height())});
    const double length_m = 0.1 * *rc::gen::inRange(1, 40);
    walls.push_back({a, a + (*rc::gen::inRange(0, 2) == 0 ? types::Vector2(length_m, 0.0)
                                                          : types::Vector2(0.0, length_m))});
  }
  return walls;
}

TEST(Regions, AreSumsOverTheirCells) {
  EXPECT_TRUE(rc::check([] {
    DrawnMap drawn(60, 50);
    DenseMap map = drawn.free(2, 2, 58, 48).map();
    draw_patches(map, 10, 16);
    const auto clearance_m = grid::clearance_m(map, grid::Boundary::kOccupiedOrUnknown);
    const FirstLabels first = first_labels(map, clearance_m, skeletonise(map, clearance_m), kFirstLabels);
    const std::vector<Region> regions = regions_of(map, clearance_m, first, {}, CompassFrame(0.0), {});
    for (std::size_t r = 0; r < first.pieces.size(); ++r) {
      std::uint32_t cells = 0, beside = 0;
      for (std::size_t i = 0; i < map.cells.size(); ++i) {
        if (first.labels[i] != first.pieces[r]) continue;
        ++cells;
        const auto width = static_cast<std::size_t>(map.width());
        for (const std::size_t j : {i - 1, i + 1, i - width, i + width})
          beside += first.labels[j] != 0 && first.labels[j] != first.pieces[r];
      }
      std::uint32_t pairs = 0;
      for (const Contact& contact : regions[r].contacts) pairs += contact.upright + contact.level;
      RC_ASSERT(regions[r].cells == cells);
      RC_ASSERT(pairs == beside);
    }
  }));
}

/// A map with patches, its first labels and their regions.
struct Labelled {
  Labelled() {
    draw_patches(map, *rc::gen::inRange(0, 14), 16);
    clearance_m = grid::clearance_m(map, grid::Boundary::kOccupiedOrUnknown);
    first = first_labels(map, clearance_m, skeletonise(map, clearance_m), kFirstLabels);
    regions = regions_of(map, clearance_m, first, draw_walls(map), frame, {});
  }
  /// The region of each cell, by number; -1 for none.
  [[nodiscard]] std::vector<int> regions_of_cells() const {
    std::map<std::uint32_t, int> numbers{{0, -1}};
    for (std::size_t r = 0; r < first.pieces.size(); ++r) numbers[first.pieces[r]] = static_cast<int>(r);
    std::vector<int> numbers_of;
    for (const std::uint32_t label : first.labels) numbers_of.push_back(numbers.at(label));
    return numbers_of;
  }

  DenseMap map = DrawnMap(50, 40).free(2, 2, 48, 38).map();
  CompassFrame frame{0.1 * *rc::gen::inRange(-7, 8)};
  std::vector<float> clearance_m;
  FirstLabels first;
  std::vector<Region> regions;
};

struct Border {
  std::uint32_t upright = 0, level = 0;
  float clearance_m = 0.0F;
};
using BordersByPair = std::map<std::pair<int, int>, Border>;

/// Cell by cell.
BordersByPair borders_of(const DenseMap& map, const std::vector<float>& clearance_m,
                         const std::vector<int>& regions) {
  BordersByPair borders;
  const auto width = static_cast<std::size_t>(map.width());
  for (std::size_t i = 0; i + width < regions.size(); ++i) {
    for (const std::size_t by : {std::size_t{1}, width}) {
      const int a = regions[i], b = regions[i + by];
      if (a < 0 || b < 0 || a == b) continue;
      Border& border = borders[std::minmax(a, b)];
      ++(by == 1 ? border.upright : border.level);
      border.clearance_m = std::max(border.clearance_m, std::min(clearance_m[i], clearance_m[i + by]));
    }
  }
  return borders;
}

void check_borders(const std::vector<Region>& regions, const BordersByPair& borders, bool with_clearance) {
  std::size_t found = 0;
  for (std::size_t r = 0; r < regions.size(); ++r) {
    for (const Contact& c : regions[r].contacts) {
      if (c.upright + c.level == 0) continue;  // a wall alone
      ++found;
      const Border& border = borders.at(std::minmax(static_cast<int>(r), static_cast<int>(c.other)));
      RC_ASSERT(c.upright == border.upright && c.level == border.level);
      if (with_clearance) RC_ASSERT(c.clearance_m == border.clearance_m);
    }
  }
  RC_ASSERT(found == 2 * borders.size());
}

TEST(Regions, TouchWhereTheirCellsAreSideBySide) {
  EXPECT_TRUE(rc::check([] {
    const Labelled of;
    check_borders(of.regions, borders_of(of.map, of.clearance_m, of.regions_of_cells()), true);
  }));
}

TEST(Regions, HaveTheBoxAndSumOfTheirCells) {
  EXPECT_TRUE(rc::check([] {
    const Labelled of;
    const std::vector<int> regions = of.regions_of_cells();
    for (std::size_t r = 0; r < of.regions.size(); ++r) {
      const Region& region = of.regions[r];
      types::Rectangle box;
      types::Vector2 sum(0.0, 0.0);
      float clearance_m = 0.0F;
      for (std::size_t i = 0; i < regions.size(); ++i) {
        if (regions[i] != static_cast<int>(r)) continue;
        sum += of.map.centre_of(of.map.cell(i));
        clearance_m = std::max(clearance_m, of.clearance_m[i]);
        for (const double x : {-0.025, 0.025})
          for (const double y : {-0.025, 0.025})
            box.extend(of.frame.from_map(of.map.centre_of(of.map.cell(i)) + types::Vector2(x, y)));
      }
      RC_ASSERT((region.box.min - box.min).norm() < 1e-9 && (region.box.max - box.max).norm() < 1e-9);
      RC_ASSERT((region.sum - sum).norm() < 1e-6 && region.clearance_m == clearance_m);
      RC_ASSERT(region.core.min.x() >= region.box.min.x() && region.core.max.x() <= region.box.max.x());
      RC_ASSERT(region.core.min.y() >= region.box.min.y() && region.core.max.y() <= region.box.max.y());
    }
  }));
}

TEST(Regions, ThatAbsorbAnotherAreThoseOfAllTheirCells) {
  EXPECT_TRUE(rc::check([] {
    Labelled of;
    std::vector<Region>& regions = of.regions;
    std::vector<int> cells = of.regions_of_cells();
    for (int merges = *rc::gen::inRange(0, 6); merges > 0; --merges) {
      const auto into = *rc::gen::inRange<std::uint32_t>(0, static_cast<std::uint32_t>(regions.size() + 1));
      if (into >= regions.size() || regions[into].contacts.empty()) continue;
      const Region a = regions[into];
      const std::uint32_t from = (*rc::gen::elementOf(a.contacts)).other;
      const Region b = regions[from];
      const bool grows_core = *rc::gen::inRange(0, 2) == 0;
      absorb(regions, into, from, grows_core);
      std::ranges::replace(cells, static_cast<int>(from), static_cast<int>(into));
      const Region& both = regions[into];
      RC_ASSERT(both.cells == a.cells + b.cells && regions[from].cells == 0U);
      RC_ASSERT(both.first == std::min(a.first, b.first) && both.version == a.version + 1);
      RC_ASSERT(both.sum == a.sum + b.sum && both.clearance_m == std::max(a.clearance_m, b.clearance_m));
      check_box(both.box, {a.box.min.cwiseMin(b.box.min), a.box.max.cwiseMax(b.box.max)});
      if (!grows_core) check_box(both.core, a.core);
      RC_ASSERT(regions[from].contacts.empty());
      check_borders(regions, borders_of(of.map, of.clearance_m, cells), false);
    }
  }));
}

TEST(Regions, ThatTouchSayTheSameOfTheirBorder) {
  EXPECT_TRUE(rc::check([] {
    Labelled of;
    std::vector<Region>& regions = of.regions;
    for (std::uint32_t into = 0; into < regions.size(); ++into) {
      if (regions[into].cells == 0 || regions[into].contacts.empty() || *rc::gen::inRange(0, 3) != 0)
        continue;
      absorb(regions, into, regions[into].contacts.front().other, true);
    }
    for (std::uint32_t r = 0; r < regions.size(); ++r) {
      for (const Contact& c : regions[r].contacts) {
        RC_ASSERT(c.other != r && regions[c.other].cells > 0);
        const auto back = std::ranges::find(regions[c.other].contacts, r, &Contact::other);
        RC_ASSERT(back != regions[c.other].contacts.end());
        RC_ASSERT(back->upright == c.upright && back->level == c.level && back->clearance_m == c.clearance_m);
        RC_ASSERT(back->open == c.open && back->wall_m == c.wall_m);
      }
    }
  }));
}

}  // namespace
}  // namespace topo::places
