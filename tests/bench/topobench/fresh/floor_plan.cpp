// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/fresh/floor_plan.hpp"

namespace topo::bench::fresh {

Box grown(const Box& box, double by_m) {
  return {box.x0 - by_m, box.y0 - by_m, box.x1 + by_m, box.y1 + by_m};
}

bool overlap(const Box& a, const Box& b) { return a.x0 < b.x1 && b.x0 < a.x1 && a.y0 < b.y1 && b.y0 < a.y1; }

sim::Polygon corners(const Box& box) {
  return {{box.x0, box.y0}, {box.x1, box.y0}, {box.x1, box.y1}, {box.x0, box.y1}};
}

Box floor_of(const Space& space, double wall_m) {
  return {space.box.x0 + wall_m, space.box.y0 + wall_m, space.box.x1, space.box.y1};
}

}  // namespace topo::bench::fresh
