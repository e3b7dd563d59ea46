// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/segmentation/regions.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "core/grid/clearance_update.hpp"
#include "tests/unit/core/places/drawn_map.hpp"
#include "tests/unit/core/places/patches.hpp"

namespace topo::places {
namespace {

using grid::DenseMap;

constexpr double kPiece_m = 0.4;

void check_contacts(const std::vector<Contact>& a, const std::vector<Contact>& b) {
  RC_ASSERT(a.size() == b.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    RC_ASSERT(a[k].other == b[k].other);
    RC_ASSERT(a[k].upright == b[k].upright && a[k].level == b[k].level);
    RC_ASSERT(a[k].wall_m == b[k].wall_m && a[k].open == b[k].open);
    RC_ASSERT(a[k].clearance_m == b[k].clearance_m);
  }
}

void check_box(const types::Rectangle& a, const types::Rectangle& b) {
  RC_ASSERT(a.min == b.min && a.max == b.max);
}

void check_regions(const std::vector<Region>& a, const std::vector<Region>& b) {
  RC_ASSERT(a.size() == b.size());
  for (std::size_t r = 0; r < a.size(); ++r) {
    check_box(a[r].box, b[r].box);
    check_box(a[r].core, b[r].core);
    for (std::size_t k = 0; k < kTurns; ++k) check_box(a[r].turned[k], b[r].turned[k]);
    RC_ASSERT(a[r].sum == b[r].sum && a[r].cells == b[r].cells && a[r].first == b[r].first);
    RC_ASSERT(a[r].clearance_m == b[r].clearance_m && a[r].straddled_m == b[r].straddled_m);
    RC_ASSERT(a[r].version == b[r].version);
    check_contacts(a[r].contacts, b[r].contacts);
  }
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

TEST(Regions, OfFirstLabelsThatChangedAreThoseOfTheWholeMap) {
  EXPECT_TRUE(rc::check([] {
    DrawnMap drawn(*rc::gen::inRange(30, 160), *rc::gen::inRange(30, 90));
    DenseMap map = drawn.free(2, 2, drawn.map().width() - 6, drawn.map().height() - 6).map();
    draw_patches(map, *rc::gen::inRange(0, 30), 24);
    grid::ClearanceUpdate update;
    update.take(map);
    FirstLabels first =
        first_labels(map, update.clearance_m(), skeletonise(map, update.clearance_m()), kPiece_m);
    std::vector<types::Segment> walls = draw_walls(map);
    double compass_rad = 0.2;
    RegionMemory memory;
    for (int step = 0; step < 6; ++step) {
      RegionMemory none;
      renew_regions(map, update.clearance_m(), first, walls, CompassFrame(compass_rad), memory);
      renew_regions(map, update.clearance_m(), first, walls, CompassFrame(compass_rad), none);
      check_regions(memory.regions, none.regions);
      draw_patches(map, *rc::gen::inRange(0, 3), *rc::gen::element(2, 8, 20));
      if (!walls.empty() && *rc::gen::inRange(0, 3) == 0) walls.pop_back();
      for (const types::Segment& wall : draw_walls(map)) walls.push_back(wall);
      if (*rc::gen::inRange(0, 4) == 0) compass_rad = *rc::gen::element(0.2, 0.5);  // there and back
      update.take(map);
      relabel(map, update.clearance_m(), skeletonise(map, update.clearance_m()), kPiece_m, *update.changed(),
              first);
    }
  }));
}

TEST(Regions, AreSumsOverTheirCells) {
  EXPECT_TRUE(rc::check([] {
    DrawnMap drawn(60, 50);
    DenseMap map = drawn.free(2, 2, 58, 48).map();
    draw_patches(map, 10, 16);
    const auto clearance_m = grid::clearance_m(map, grid::Boundary::kOccupiedOrUnknown);
    const FirstLabels first = first_labels(map, clearance_m, skeletonise(map, clearance_m), kPiece_m);
    RegionMemory memory;
    renew_regions(map, clearance_m, first, {}, CompassFrame(0.0), memory);
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
      for (const Contact& contact : memory.regions[r].contacts) pairs += contact.upright + contact.level;
      RC_ASSERT(memory.regions[r].cells == cells);
      RC_ASSERT(pairs == beside);
    }
  }));
}

}  // namespace
}  // namespace topo::places
