// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tests/bench/topobench/fresh/floor_plan.hpp"
#include "tests/sim/random.hpp"

namespace topo::bench::fresh {

/// Measures of one wing, drawn once, so that its rooms look alike as those of one architect do. The ranges
/// are those of the sixteen public plans, by eye.
struct LayoutRules {
  double strip_m = 5.5;                       ///< depth of a row of rooms along a corridor
  double corridor_m = 2.0;                    ///< width
  double room_min_m = 2.6, room_max_m = 5.5;  ///< along the corridor
  bool modular = false;                       ///< rooms of a row are equally wide
  double closed = 0.05;                       ///< share of rooms that are shafts or locked
  double open_block = 0.15;                   ///< share of blocks that are one large room
};

/// Of an office floor.
LayoutRules office_rules(sim::Random& random);
/// Of a house: shallow rows, narrow corridors.
LayoutRules house_rules(sim::Random& random);

/// Corridors with rooms on both sides, crossing ones where the block is large, so that loops arise.
std::vector<Space> office_layout(const Box& block, const LayoutRules& rules, sim::Random& random);
/// A corridor around a core, with rooms outside of it; the core is rooms, a hall or a closed court.
std::vector<Space> ring_layout(const Box& block, const LayoutRules& rules, sim::Random& random);
/// Halls, and a row of rooms along a corridor beside them.
std::vector<Space> hall_layout(const Box& block, const LayoutRules& rules, sim::Random& random);

}  // namespace topo::bench::fresh
