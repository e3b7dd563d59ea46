// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/fresh/blocks.hpp"

#include <algorithm>
#include <cmath>

#include "tests/bench/topobench/fresh/draws.hpp"

namespace topo::bench::fresh {
namespace {

constexpr double kHallFrom_m2 = 60.0;
constexpr double kDeepRow = 1.45;     // a row may be so much deeper than the rules say
constexpr double kSuiteFrom_m = 5.5;  // a deeper room may have another behind it
constexpr double kSuite = 0.12;
constexpr double kLargeRoom = 0.15;

Use use_of(const Box& box, const LayoutRules& rules, sim::Random& random) {
  if (happens(random, rules.closed)) return Use::kClosed;
  return box.area_m2() >= kHallFrom_m2 ? Use::kHall : Use::kRoom;
}

Box part_of(const Box& box, bool along_x, double from_m, double to_m) {
  return along_x ? Box{box.x0 + from_m, box.y0, box.x0 + to_m, box.y1}
                 : Box{box.x0, box.y0 + from_m, box.x1, box.y0 + to_m};
}

/// Where a row is cut: from 0 to its length, all parts at least as long as the shortest room.
std::vector<double> cuts_of(double length_m, const LayoutRules& rules, sim::Random& random) {
  std::vector<double> cuts{0.0};
  const double module_m = length_of(random, rules.room_min_m, rules.room_max_m);
  while (length_m - cuts.back() > 2.0 * rules.room_min_m) {
    double room_m = rules.modular ? module_m : length_of(random, rules.room_min_m, rules.room_max_m);
    if (happens(random, kLargeRoom)) room_m = snapped(1.9 * room_m);
    if (length_m - cuts.back() - room_m < rules.room_min_m) break;
    cuts.push_back(snapped(cuts.back() + room_m));
  }
  cuts.push_back(length_m);
  return cuts;
}

void add_room(const Box& box, bool along_x, const LayoutRules& rules, sim::Random& random,
              std::vector<Space>& out) {
  const double depth_m = along_x ? box.height() : box.width();
  if (depth_m < kSuiteFrom_m || !happens(random, kSuite)) {
    out.push_back({box, use_of(box, rules, random)});
    return;
  }
  const double cut_m = snapped(depth_m * random.uniform(0.4, 0.6));
  for (const Box& part : {part_of(box, !along_x, 0.0, cut_m), part_of(box, !along_x, cut_m, depth_m)})
    out.push_back({part, use_of(part, rules, random)});
}

constexpr std::size_t kParallel = 4;  // corridors, at most

/// Middles of the corridors that divide a length, with some play.
std::vector<double> middles_of(double length_m, std::size_t most, const LayoutRules& rules,
                               sim::Random& random) {
  const double pitch_m = 2.0 * rules.strip_m * random.uniform(1.0, 1.25) + rules.corridor_m;
  const auto n =
      static_cast<std::size_t>(std::clamp(std::round(length_m / pitch_m), 1.0, static_cast<double>(most)));
  std::vector<double> middles;
  for (std::size_t i = 0; i < n; ++i) {
    const double even = (static_cast<double>(i) + 0.5) / static_cast<double>(n);
    const double play = n == 1 ? 0.12 : 0.06 / static_cast<double>(n);
    middles.push_back(length_m * (even + random.uniform(-play, play)));
  }
  return middles;
}

/// Corridors that run along x or y, and the blocks between them.
void cut_by_corridors(const Box& box, bool along_x, std::size_t most, const Sides& corridors,
                      const LayoutRules& rules, sim::Random& random, std::vector<Space>& out) {
  const double length_m = along_x ? box.height() : box.width();
  double from_m = 0.0;
  Sides sides = corridors;
  for (const double middle_m : middles_of(length_m, most, rules, random)) {
    const double corridor_m = std::max(rules.corridor_m + length_of(random, -0.3, 0.3), 1.4);
    const double begin_m = snapped(middle_m - 0.5 * corridor_m), end_m = snapped(begin_m + corridor_m);
    Sides lower = sides;
    (along_x ? lower.above : lower.right) = true;
    divide(part_of(box, !along_x, from_m, begin_m), lower, rules, random, out);
    out.push_back({part_of(box, !along_x, begin_m, end_m), Use::kCorridor});
    (along_x ? sides.below : sides.left) = true;
    from_m = end_m;
  }
  (along_x ? sides.above : sides.right) = along_x ? corridors.above : corridors.right;
  divide(part_of(box, !along_x, from_m, length_m), sides, rules, random, out);
}

/// Two rows back to back, each at its own corridor.
void add_two_rows(const Box& box, bool along_x, const LayoutRules& rules, sim::Random& random,
                  std::vector<Space>& out) {
  const double length_m = along_x ? box.height() : box.width();
  const double cut_m = snapped(length_m * random.uniform(0.42, 0.58));
  add_row(part_of(box, !along_x, 0.0, cut_m), along_x, rules, random, out);
  add_row(part_of(box, !along_x, cut_m, length_m), along_x, rules, random, out);
}

}  // namespace

void add_row(const Box& box, bool along_x, const LayoutRules& rules, sim::Random& random,
             std::vector<Space>& out) {
  const std::vector<double> cuts = cuts_of(along_x ? box.width() : box.height(), rules, random);
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
    add_room(part_of(box, along_x, cuts[i], cuts[i + 1]), along_x, rules, random, out);
}

void divide(const Box& box, const Sides& corridors, const LayoutRules& rules, sim::Random& random,
            std::vector<Space>& out) {
  const double row_m = kDeepRow * rules.strip_m;
  const bool is_wide = box.width() >= box.height();
  const bool has_both = corridors.beside() && corridors.across();
  // Rooms lie side by side along the corridor that they open to.
  const bool row_along_x =
      has_both || (!corridors.beside() && !corridors.across()) ? is_wide : corridors.across();
  if (std::min(box.width(), box.height()) < rules.room_min_m ||
      (box.area_m2() < 160.0 && happens(random, rules.open_block))) {
    out.push_back({box, use_of(box, rules, random)});
  } else if ((row_along_x ? box.height() : box.width()) <= row_m) {
    add_row(box, row_along_x, rules, random, out);
  } else if (corridors.below && corridors.above && box.height() <= 2.0 * row_m) {
    add_two_rows(box, true, rules, random, out);
  } else if (corridors.left && corridors.right && box.width() <= 2.0 * row_m) {
    add_two_rows(box, false, rules, random, out);
  } else {
    // A new corridor begins at one that is there.
    const bool along_x =
        has_both || (!corridors.beside() && !corridors.across()) ? is_wide : corridors.beside();
    const double across_m = along_x ? box.height() : box.width();
    if (across_m < 1.5 * rules.strip_m + rules.corridor_m)
      add_row(box, row_along_x, rules, random, out);
    else if (!corridors.beside() && !corridors.across() &&
             across_m > 3.0 * rules.strip_m + 2.0 * rules.corridor_m)
      // Several corridors side by side: one or two across first, which join them.
      cut_by_corridors(box, !along_x, 1 + one_of(random, 2), corridors, rules, random, out);
    else
      cut_by_corridors(box, along_x, kParallel, corridors, rules, random, out);
  }
}

}  // namespace topo::bench::fresh
