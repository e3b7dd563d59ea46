// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tests/sim/world.hpp"

namespace topo::sim {

/// Vertical rectangle that a level ray can hit.
struct Edge {
  Vector2 a, b;
  double z_min_m, z_max_m;
  double transmission = 0.0;  ///< probability that a laser beam passes (glass)
  Surface surface = Surface::kWall;
};

/// Ray parameter t and cosine of incidence at the crossing of ray and edge; t is infinite when there is none.
/// t is in units of the ray's direction, which need not have length 1 in the plane.
struct Crossing {
  double t;
  double cos_incidence;
};
Crossing cross(const Ray& ray, const Edge& edge);

/// The point where the ray enters the prism through its top or bottom; t is infinite when there is none.
Crossing cross_caps(const Ray& ray, const Prism& prism);

/// Analytic edges in a grid of coarse cells, with the distance to the next occupied cell, so that a ray
/// crosses empty space in few steps and walls at any angle stay straight. Immutable after construction.
class EdgeIndex {
 public:
  EdgeIndex() = default;
  EdgeIndex(std::vector<Edge> edges, std::span<const Prism> prisms);

  /// Replaces `best` by the nearest edge or cap that is closer than best.range_m.
  void cast(const Ray& ray, double glass_draw, std::span<const Prism> prisms, RayHit& best) const;

  /// Calls visit(edge) for the edges near a point; an edge may be visited twice.
  template <class Visit>
  void near(const Vector2& p, double radius_m, const Visit& visit) const;

  /// True when the point is in one of the prisms at this height.
  [[nodiscard]] bool in_prism(double x_m, double y_m, double z_m, std::span<const Prism> prisms) const;

  [[nodiscard]] std::span<const Edge> edges() const { return edges_; }
  [[nodiscard]] const types::Rectangle& bounds() const { return bounds_; }

 private:
  static constexpr double kCell_m = 0.25;
  void lay_out(std::span<const Prism> prisms);
  void insert_edges();
  void insert_prisms(std::span<const Prism> prisms);
  void measure_gaps();
  [[nodiscard]] std::size_t cell(int ix, int iy) const {
    return static_cast<std::size_t>(iy) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(ix);
  }
  [[nodiscard]] int column(double x_m) const;
  [[nodiscard]] int row(double y_m) const;
  void test_cell(std::size_t index, const Ray& ray, double glass_draw, std::span<const Prism> prisms,
                 RayHit& best) const;

  std::vector<Edge> edges_;
  types::Rectangle bounds_;
  int columns_ = 0, rows_ = 0;
  std::vector<std::uint32_t> edge_begin_, edge_ids_;    // cells to edges, compressed rows
  std::vector<std::uint32_t> prism_begin_, prism_ids_;  // cells to prisms with a top or bottom to hit
  std::vector<std::uint8_t> gap_;  // distance (Chebyshev, cells) to the next occupied cell
};

template <class Visit>
void EdgeIndex::near(const Vector2& p, double radius_m, const Visit& visit) const {
  if (columns_ == 0) return;
  const int ix = column(p.x());
  const int iy = row(p.y());
  if (gap_[cell(ix, iy)] * kCell_m > radius_m + kCell_m && bounds_.contains(p)) return;
  const int x1 = column(p.x() + radius_m);
  const int y1 = row(p.y() + radius_m);
  for (int y = row(p.y() - radius_m); y <= y1; ++y) {
    for (int x = column(p.x() - radius_m); x <= x1; ++x) {
      const std::size_t c = cell(x, y);
      for (std::uint32_t k = edge_begin_[c]; k < edge_begin_[c + 1]; ++k) visit(edges_[edge_ids_[k]]);
    }
  }
}

}  // namespace topo::sim
