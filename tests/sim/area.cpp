// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/sim/area.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace topo::sim {

namespace {

constexpr float kFar = 1e12F;

// Squared distance transform of one line, in place: lower envelope of parabolas.
void transform_line(std::vector<float>& f, std::vector<float>& out, std::vector<int>& vertex,
                    std::vector<float>& border) {
  const int n = static_cast<int>(f.size());
  const auto value = [&](int i) { return static_cast<double>(f[static_cast<std::size_t>(i)]); };
  const auto meet = [&](int q, int p) {
    return ((value(q) + double(q) * q) - (value(p) + double(p) * p)) / (2.0 * (q - p));
  };
  int k = 0;
  vertex[0] = 0;
  border[0] = -kFar;
  border[1] = kFar;
  for (int q = 1; q < n; ++q) {
    double s = meet(q, vertex[static_cast<std::size_t>(k)]);
    while (k > 0 && s <= static_cast<double>(border[static_cast<std::size_t>(k)])) {
      --k;
      s = meet(q, vertex[static_cast<std::size_t>(k)]);
    }
    ++k;
    vertex[static_cast<std::size_t>(k)] = q;
    border[static_cast<std::size_t>(k)] = static_cast<float>(s);
    border[static_cast<std::size_t>(k) + 1] = kFar;
  }
  k = 0;
  for (int q = 0; q < n; ++q) {
    while (border[static_cast<std::size_t>(k) + 1] < static_cast<float>(q)) ++k;
    const int v = vertex[static_cast<std::size_t>(k)];
    out[static_cast<std::size_t>(q)] = static_cast<float>(double(q - v) * (q - v) + value(v));
  }
  f.swap(out);
}

void transform_lines(std::vector<float>& field, int lines, int length, std::size_t line_stride,
                     std::size_t stride) {
  std::vector<float> f(static_cast<std::size_t>(length)), out(f.size()), border(f.size() + 1);
  std::vector<int> vertex(f.size());
  for (int line = 0; line < lines; ++line) {
    const std::size_t base = static_cast<std::size_t>(line) * line_stride;
    for (std::size_t i = 0; i < f.size(); ++i) f[i] = field[base + i * stride];
    transform_line(f, out, vertex, border);
    for (std::size_t i = 0; i < f.size(); ++i) field[base + i * stride] = f[i];
  }
}

// Marks the free cells along a beam from p to its end. A building needs hundreds of millions of steps, so
// they are counted in cells, without a division per step.
void mark_beam(const Vector2& p, const Vector2& direction, double range_m, const Raster& free,
               Raster& visible) {
  constexpr double kStep = 0.7;  // cells
  const Vector2 from = (p - free.origin) / free.resolution_m;
  const Vector2 step = kStep * direction;
  const int steps = static_cast<int>(std::ceil(range_m / (kStep * free.resolution_m)));
  // Rounds down, for positions at most one cell outside.
  const auto cell = [](double at) { return static_cast<std::uint32_t>(static_cast<int>(at + 1.0) - 1); };
  const auto width = static_cast<std::uint32_t>(free.width), height = static_cast<std::uint32_t>(free.height);
  for (int k = 0; k < steps; ++k) {
    const std::uint32_t x = cell(from.x() + k * step.x()), y = cell(from.y() + k * step.y());
    if (x >= width || y >= height) return;  // a raster is convex: the beam does not re-enter it
    const std::size_t i = std::size_t{y} * width + x;
    visible.cells[i] |= static_cast<std::uint8_t>(free.cells[i] != 0);
  }
}

}  // namespace

std::vector<float> clearance_m(const Raster& free) {
  // With an additional ring of solid cells, because everything outside the raster is solid.
  const int w = free.width + 2;
  const int h = free.height + 2;
  std::vector<float> field(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), 0.0F);
  const auto at = [w](int x, int y) {
    return static_cast<std::size_t>(y + 1) * static_cast<std::size_t>(w) + static_cast<std::size_t>(x + 1);
  };
  for (int y = 0; y < free.height; ++y) {
    for (int x = 0; x < free.width; ++x) field[at(x, y)] = free.at(x, y) != 0 ? kFar : 0.0F;
  }
  transform_lines(field, w, h, 1, static_cast<std::size_t>(w));
  transform_lines(field, h, w, static_cast<std::size_t>(w), 1);
  std::vector<float> out(free.cells.size());
  for (int y = 0; y < free.height; ++y) {
    for (int x = 0; x < free.width; ++x) {
      out[free.index(x, y)] = std::sqrt(field[at(x, y)]) * static_cast<float>(free.resolution_m);
    }
  }
  return out;
}

Se2 roomiest_place(const Raster& free) {
  const std::vector<float> clearance = clearance_m(free);
  const auto best =
      static_cast<std::size_t>(std::max_element(clearance.begin(), clearance.end()) - clearance.begin());
  const auto width = static_cast<std::size_t>(free.width);
  const Vector2 p = free.center(static_cast<int>(best % width), static_cast<int>(best / width));
  return {p.x(), p.y(), 0.0};
}

Raster reachable_poses(const Raster& free, const Vector2& start, double radius_m) {
  const std::vector<float> clearance = clearance_m(free);
  Raster reached(free.resolution_m, free.origin, free.width, free.height);
  std::vector<std::pair<int, int>> todo;
  const auto visit = [&](int x, int y) {
    if (!free.inside(x, y) || reached.at(x, y) != 0) return;
    if (clearance[free.index(x, y)] < static_cast<float>(radius_m)) return;
    reached.set(x, y, 1);
    todo.emplace_back(x, y);
  };
  visit(free.column(start.x()), free.row(start.y()));
  while (!todo.empty()) {
    const auto [x, y] = todo.back();
    todo.pop_back();
    visit(x + 1, y), visit(x - 1, y), visit(x, y + 1), visit(x, y - 1);
  }
  return reached;
}

ReachableArea reachable_area(const World& world, const Vector2& start, double radius_m, double z_m,
                             double range_max_m) {
  constexpr double kSpacing_m = 0.4;  // between the viewpoints
  constexpr int kBeams = 720;
  const Raster& free = world.structure();
  ReachableArea area{reachable_poses(free, start, radius_m),
                     Raster(free.resolution_m, free.origin, free.width, free.height)};
  const int every = std::max(1, static_cast<int>(kSpacing_m / free.resolution_m));
  RayOptions options;
  options.range_max_m = range_max_m;
  std::vector<Vector2> directions;
  for (int i = 0; i < kBeams; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kBeams;
    directions.emplace_back(std::cos(angle), std::sin(angle));
  }
  for (int y = 0; y < free.height; ++y) {
    for (int x = 0; x < free.width; ++x) {
      if (area.poses.at(x, y) == 0) continue;
      area.visible.set(x, y, 1);
      if (x % every != 0 || y % every != 0) continue;
      const Vector2 p = free.center(x, y);
      for (const Vector2& d : directions) {
        const double range = world.cast({p.x(), p.y(), z_m, d.x(), d.y(), 0.0}, options).range_m;
        mark_beam(p, d, std::min(range, range_max_m), free, area.visible);
      }
    }
  }
  return area;
}

}  // namespace topo::sim
