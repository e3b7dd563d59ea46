// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/sim/edge_index.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace topo::sim {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Cells also contain edges within this distance, so that a ray on the border of two cells meets them.
constexpr double kMargin_m = 1e-4;
constexpr double kAhead_m = 1e-7;

double cross_product(double ax, double ay, double bx, double by) { return ax * by - ay * bx; }

// True when the edge enters the square of half side h around c.
bool reaches(const Edge& edge, const Vector2& c, double h) {
  const Vector2 e = edge.b - edge.a;
  const Vector2 r = c - edge.a;
  return std::abs(cross_product(e.x(), e.y(), r.x(), r.y())) <=
         (std::abs(e.x()) + std::abs(e.y())) * h + 1e-12;
}

// Converts lists per cell to compressed rows.
void compress(const std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs, std::size_t cells,
              std::vector<std::uint32_t>& begin, std::vector<std::uint32_t>& ids) {
  begin.assign(cells + 1, 0);
  for (const auto& [c, id] : pairs) ++begin[c + 1];
  for (std::size_t c = 0; c < cells; ++c) begin[c + 1] += begin[c];
  ids.resize(pairs.size());
  std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
  for (const auto& [c, id] : pairs) ids[next[c]++] = id;
}

}  // namespace

Crossing cross(const Ray& ray, const Edge& edge) {
  const double ex = edge.b.x() - edge.a.x();
  const double ey = edge.b.y() - edge.a.y();
  const double denominator = cross_product(ray.dx, ray.dy, ex, ey);
  if (denominator == 0.0) return {kInfinity, 0.0};
  const double rx = edge.a.x() - ray.x;
  const double ry = edge.a.y() - ray.y;
  const double t = cross_product(rx, ry, ex, ey) / denominator;
  const double u = cross_product(rx, ry, ray.dx, ray.dy) / denominator;
  if (!(t >= 0.0) || u < -1e-9 || u > 1.0 + 1e-9) return {kInfinity, 0.0};
  const double z = ray.z + t * ray.dz;
  if (z < edge.z_min_m || z > edge.z_max_m) return {kInfinity, 0.0};
  return {t, std::abs(denominator) / std::sqrt(ex * ex + ey * ey)};
}

Crossing cross_caps(const Ray& ray, const Prism& prism) {
  if (ray.dz == 0.0) return {kInfinity, 0.0};
  const double z_cap = ray.dz > 0.0 ? prism.z_min_m : prism.z_max_m;
  const double t = (z_cap - ray.z) / ray.dz;
  if (!(t >= 0.0) || !contains(prism.outline, {ray.x + t * ray.dx, ray.y + t * ray.dy}))
    return {kInfinity, 0.0};
  return {t, std::abs(ray.dz)};
}

EdgeIndex::EdgeIndex(std::vector<Edge> edges, std::span<const Prism> prisms) : edges_(std::move(edges)) {
  for (const Edge& e : edges_) {
    bounds_.extend(e.a);
    bounds_.extend(e.b);
  }
  if (bounds_.empty()) return;
  bounds_.min -= Vector2(kCell_m, kCell_m);
  bounds_.max += Vector2(kCell_m, kCell_m);
  lay_out(prisms);
}

void EdgeIndex::lay_out(std::span<const Prism> prisms) {
  const Vector2 size = bounds_.max - bounds_.min;
  columns_ = static_cast<int>(std::ceil(size.x() / kCell_m));
  rows_ = static_cast<int>(std::ceil(size.y() / kCell_m));
  insert_edges();
  insert_prisms(prisms);
  measure_gaps();
}

int EdgeIndex::column(double x_m) const {
  return std::clamp(static_cast<int>(std::floor((x_m - bounds_.min.x()) / kCell_m)), 0, columns_ - 1);
}

int EdgeIndex::row(double y_m) const {
  return std::clamp(static_cast<int>(std::floor((y_m - bounds_.min.y()) / kCell_m)), 0, rows_ - 1);
}

void EdgeIndex::insert_edges() {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (std::uint32_t id = 0; id < edges_.size(); ++id) {
    const Edge& e = edges_[id];
    const Vector2 low = e.a.cwiseMin(e.b) - Vector2(kMargin_m, kMargin_m);
    const Vector2 high = e.a.cwiseMax(e.b) + Vector2(kMargin_m, kMargin_m);
    for (int iy = row(low.y()); iy <= row(high.y()); ++iy) {
      for (int ix = column(low.x()); ix <= column(high.x()); ++ix) {
        const Vector2 center = bounds_.min + kCell_m * Vector2(ix + 0.5, iy + 0.5);
        if (reaches(e, center, 0.5 * kCell_m + kMargin_m))
          pairs.emplace_back(static_cast<std::uint32_t>(cell(ix, iy)), id);
      }
    }
  }
  compress(pairs, cell(0, rows_), edge_begin_, edge_ids_);
}

void EdgeIndex::insert_prisms(std::span<const Prism> prisms) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (std::uint32_t id = 0; id < prisms.size(); ++id) {
    const types::Rectangle box = sim::bounds(prisms[id].outline);
    for (int iy = row(box.min.y() - kMargin_m); iy <= row(box.max.y() + kMargin_m); ++iy) {
      for (int ix = column(box.min.x() - kMargin_m); ix <= column(box.max.x() + kMargin_m); ++ix) {
        pairs.emplace_back(static_cast<std::uint32_t>(cell(ix, iy)), id);
      }
    }
  }
  compress(pairs, cell(0, rows_), prism_begin_, prism_ids_);
}

void EdgeIndex::measure_gaps() {
  constexpr int kFar = 255;
  gap_.assign(cell(0, rows_), kFar);
  for (std::size_t c = 0; c < gap_.size(); ++c) {
    if (edge_begin_[c] != edge_begin_[c + 1] || prism_begin_[c] != prism_begin_[c + 1]) gap_[c] = 0;
  }
  // Two passes over the eight neighbours give the Chebyshev distance exactly (Borgefors 1986).
  const auto relax = [&](int x, int y, int nx, int ny) {
    if (nx < 0 || ny < 0 || nx >= columns_ || ny >= rows_) return;
    const int candidate = std::min(gap_[cell(nx, ny)] + 1, kFar);
    if (candidate < gap_[cell(x, y)]) gap_[cell(x, y)] = static_cast<std::uint8_t>(candidate);
  };
  for (int y = 0; y < rows_; ++y) {
    for (int x = 0; x < columns_; ++x) {
      relax(x, y, x - 1, y), relax(x, y, x - 1, y - 1), relax(x, y, x, y - 1), relax(x, y, x + 1, y - 1);
    }
  }
  for (int y = rows_ - 1; y >= 0; --y) {
    for (int x = columns_ - 1; x >= 0; --x) {
      relax(x, y, x + 1, y), relax(x, y, x + 1, y + 1), relax(x, y, x, y + 1), relax(x, y, x - 1, y + 1);
    }
  }
}

void EdgeIndex::test_cell(std::size_t index, const Ray& ray, double glass_draw, std::span<const Prism> prisms,
                          RayHit& best) const {
  for (std::uint32_t k = edge_begin_[index]; k < edge_begin_[index + 1]; ++k) {
    const Edge& edge = edges_[edge_ids_[k]];
    if (edge.transmission > glass_draw) continue;
    const Crossing hit = cross(ray, edge);
    if (hit.t < best.range_m) best = {hit.t, hit.cos_incidence, edge.surface};
  }
  if (ray.dz == 0.0) return;
  for (std::uint32_t k = prism_begin_[index]; k < prism_begin_[index + 1]; ++k) {
    const Crossing hit = cross_caps(ray, prisms[prism_ids_[k]]);
    if (hit.t < best.range_m) best = {hit.t, hit.cos_incidence, Surface::kWall};
  }
}

void EdgeIndex::cast(const Ray& ray, double glass_draw, std::span<const Prism> prisms, RayHit& best) const {
  if (columns_ == 0) return;
  const double inverse_x =
      1.0 / ray.dx;  // infinite for a ray along the other axis: compared, never multiplied by 0
  const double inverse_y = 1.0 / ray.dy;
  // Clips the ray to the grid.
  double t = 0.0;
  double t_leave = best.range_m;
  const auto clip = [&](double p, double d, double inverse, double low, double high) {
    if (d == 0.0) {
      if (p < low || p > high) t_leave = -1.0;
      return;
    }
    const double t1 = (low - p) * inverse;
    const double t2 = (high - p) * inverse;
    t = std::max(t, std::min(t1, t2));
    t_leave = std::min(t_leave, std::max(t1, t2));
  };
  clip(ray.x, ray.dx, inverse_x, bounds_.min.x(), bounds_.max.x());
  clip(ray.y, ray.dy, inverse_y, bounds_.min.y(), bounds_.max.y());
  // Looks up cells slightly ahead, so that a ray along a border, or one that starts on it, always advances;
  // the margin of the cells is wider.
  const double ahead_x = ray.dx > 0.0 ? kAhead_m : -kAhead_m;
  const double ahead_y = ray.dy > 0.0 ? kAhead_m : -kAhead_m;
  while (t <= t_leave && t < best.range_m) {
    const int ix = column(ray.x + t * ray.dx + ahead_x);
    const int iy = row(ray.y + t * ray.dy + ahead_y);
    const std::size_t here = cell(ix, iy);
    const int gap = gap_[here];
    if (gap == 0) test_cell(here, ray, glass_draw, prisms, best);
    const int reach = std::max(gap - 1, 0);
    double t_exit = kInfinity;
    if (ray.dx != 0.0) {
      const int border = ray.dx > 0.0 ? ix + 1 + reach : ix - reach;
      t_exit = (bounds_.min.x() + border * kCell_m - ray.x) * inverse_x;
    }
    if (ray.dy != 0.0) {
      const int border = ray.dy > 0.0 ? iy + 1 + reach : iy - reach;
      t_exit = std::min(t_exit, (bounds_.min.y() + border * kCell_m - ray.y) * inverse_y);
    }
    t = t_exit > t ? t_exit : t + kAhead_m;  // steps over the last cell's border despite rounding
  }
}

bool EdgeIndex::in_prism(double x_m, double y_m, double z_m, std::span<const Prism> prisms) const {
  if (columns_ == 0 || !bounds_.contains({x_m, y_m})) return false;
  const std::size_t c = cell(column(x_m), row(y_m));
  for (std::uint32_t k = prism_begin_[c]; k < prism_begin_[c + 1]; ++k) {
    const Prism& prism = prisms[prism_ids_[k]];
    if (z_m >= prism.z_min_m && z_m <= prism.z_max_m && contains(prism.outline, {x_m, y_m})) return true;
  }
  return false;
}

}  // namespace topo::sim
