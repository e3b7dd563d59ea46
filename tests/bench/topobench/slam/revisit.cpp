// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/slam/revisit.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <memory>
#include <vector>

#include "core/grid/occupancy_grid.hpp"
#include "tests/bench/topobench/slam/beam_fan.hpp"
#include "tests/bench/topobench/slam/visits.hpp"

namespace topo::bench {
namespace {

using types::Vector2;

/// A set of stretches per cell over the box that the map fills.
class Marks {
 public:
  Marks(grid::CellIndex min, int width, int height, std::size_t words)
      : min_(min), width_(width), height_(height), words_(words) {
    bits_.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * words, 0);
  }
  void set(grid::CellIndex cell, std::size_t stretch) {
    if (is_inside(cell)) bits_[words_ * place(cell) + stretch / 64] |= std::uint64_t{1} << (stretch % 64);
  }
  [[nodiscard]] bool any(grid::CellIndex cell, const std::uint64_t* of) const {
    if (!is_inside(cell)) return false;
    const std::uint64_t* bits = &bits_[words_ * place(cell)];
    for (std::size_t i = 0; i < words_; ++i) {
      if ((bits[i] & of[i]) != 0) return true;
    }
    return false;
  }

 private:
  [[nodiscard]] bool is_inside(grid::CellIndex cell) const {
    const int x = cell.x - min_.x, y = cell.y - min_.y;
    return x >= 0 && y >= 0 && x < width_ && y < height_;
  }
  [[nodiscard]] std::size_t place(grid::CellIndex cell) const {
    return static_cast<std::size_t>(cell.y - min_.y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(cell.x - min_.x);
  }
  grid::CellIndex min_;
  int width_, height_;
  std::size_t words_;
  std::vector<std::uint64_t> bits_;
};

class Counter {
 public:
  Counter(std::span<const slam::KeyframePtr> keyframes, std::span<const types::Se2> poses,
          const grid::OccupancyGrid& map, double tolerance_m)
      : keyframes_(keyframes), poses_(poses), map_(map), tolerance_m_(tolerance_m), visits_(poses) {
    const grid::CellBox box = map.known_box();
    const int width = static_cast<int>(box.width()), height = static_cast<int>(box.height());
    hit_ = std::make_unique<Marks>(box.min, width, height, visits_.words());
    fans_.reserve(keyframes.size());
  }

  RevisitShare run() {
    for (std::size_t i = 0; i < keyframes_.size(); ++i) mark(i);
    RevisitShare out;
    for (std::size_t i = 0; i < keyframes_.size(); ++i) {
      for (const slam::Point& hit : keyframes_[i]->hits) {
        const bool within = is_near_a_hit(poses_[i] * Vector2(hit.cast<double>()), visits_.stretch_of(i));
        out.points += within || is_contradicted(i, hit) ? 1U : 0U;
        out.within += within ? 1U : 0U;
      }
    }
    return out;
  }

 private:
  void mark(std::size_t i) {
    for (const slam::Point& hit : keyframes_[i]->hits)
      hit_->set(map_.cell_at(poses_[i] * Vector2(hit.cast<double>())), visits_.stretch_of(i));
    fans_.emplace_back(*keyframes_[i], poses_[i]);
  }

  /// Is there an occupied cell within the tolerance that another visit hit?
  [[nodiscard]] bool is_near_a_hit(const Vector2& p, std::size_t stretch) const {
    const int reach = static_cast<int>(std::ceil(tolerance_m_ / map_.resolution_m()));
    const grid::CellIndex centre = map_.cell_at(p);
    for (int y = -reach; y <= reach; ++y) {
      for (int x = -reach; x <= reach; ++x) {
        const grid::CellIndex cell{centre.x + x, centre.y + y};
        if ((map_.centre_of(cell) - p).norm() > tolerance_m_) continue;
        if (hit_->any(cell, visits_.others(stretch)) && map_.state(cell) == grid::CellState::kOccupied)
          return true;
      }
    }
    return false;
  }

  [[nodiscard]] bool is_contradicted(std::size_t i, const slam::Point& hit) const {
    SurfacePoint surface = surface_at(*keyframes_[i], hit);
    surface = {poses_[i] * surface.position, Eigen::Rotation2Dd(poses_[i].theta_rad) * surface.normal};
    for (std::size_t k = 0; k < fans_.size(); ++k) {
      if (visits_.are_apart(visits_.stretch_of(i), visits_.stretch_of(k)) &&
          fans_[k].contradicts(surface, tolerance_m_))
        return true;
    }
    return false;
  }

  std::span<const slam::KeyframePtr> keyframes_;
  std::span<const types::Se2> poses_;
  const grid::OccupancyGrid& map_;
  double tolerance_m_;
  Visits visits_;
  std::unique_ptr<Marks> hit_;
  std::vector<BeamFan> fans_;
};

}  // namespace

RevisitShare revisit_share(std::span<const slam::KeyframePtr> keyframes, std::span<const types::Se2> poses,
                           const grid::OccupancyGrid& map, double tolerance_m) {
  return Counter(keyframes, poses, map, tolerance_m).run();
}

}  // namespace topo::bench
