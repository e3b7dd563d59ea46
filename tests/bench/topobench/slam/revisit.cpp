// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/slam/revisit.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

namespace topo::bench {
namespace {

using types::Vector2;

constexpr double kStretch_m = 2.5;
constexpr double kGap_m = 15.0;
constexpr double kDetour = 2.0;         ///< way to distance between two visits
constexpr double kPlaceRadius_m = 0.5;  ///< around a point: its place
constexpr double kEnd_m = 0.15;         ///< of a beam: there it goes through nothing

/// The path in stretches, and for each the others that belong to another visit.
class Visits {
 public:
  explicit Visits(std::span<const types::Se2> poses) {
    double way = 0.0;
    std::vector<double> at;
    std::vector<Vector2> where;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      if (i > 0) way += (poses[i].translation() - poses[i - 1].translation()).norm();
      const auto stretch = static_cast<std::size_t>(way / kStretch_m);
      while (at.size() <= stretch) {
        at.push_back(way);
        where.push_back(poses[i].translation());
      }
      stretch_of_.push_back(stretch);
    }
    words_ = (at.size() + 63) / 64;
    others_.assign(at.size() * words_, 0);
    for (std::size_t a = 0; a < at.size(); ++a) {
      for (std::size_t b = 0; b < at.size(); ++b) {
        const double apart = std::abs(at[a] - at[b]);
        if (apart >= kGap_m && apart >= kDetour * (where[a] - where[b]).norm())
          others_[a * words_ + b / 64] |= std::uint64_t{1} << (b % 64);
      }
    }
  }

  [[nodiscard]] std::size_t words() const { return words_; }
  [[nodiscard]] std::size_t stretch_of(std::size_t keyframe) const { return stretch_of_[keyframe]; }
  [[nodiscard]] const std::uint64_t* others(std::size_t stretch) const { return &others_[stretch * words_]; }

 private:
  std::size_t words_ = 0;
  std::vector<std::size_t> stretch_of_;
  std::vector<std::uint64_t> others_;
};

/// A set of stretches per cell over the box that the map fills.
class Marks {
 public:
  Marks(grid::CellIndex min, int width, int height, std::size_t words)
      : min_(min), width_(width), height_(height), words_(words) {
    bits_.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * words, 0);
  }
  void set(grid::CellIndex cell, std::size_t stretch) {
    if (std::uint64_t* bits = at(cell)) bits[stretch / 64] |= std::uint64_t{1} << (stretch % 64);
  }
  [[nodiscard]] bool any(grid::CellIndex cell, const std::uint64_t* of) const {
    const std::uint64_t* bits = const_cast<Marks*>(this)->at(cell);
    if (bits == nullptr) return false;
    for (std::size_t i = 0; i < words_; ++i) {
      if ((bits[i] & of[i]) != 0) return true;
    }
    return false;
  }

 private:
  std::uint64_t* at(grid::CellIndex cell) {
    const int x = cell.x - min_.x, y = cell.y - min_.y;
    if (x < 0 || y < 0 || x >= width_ || y >= height_) return nullptr;
    return &bits_[(static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                   static_cast<std::size_t>(x)) *
                  words_];
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
    passed_ = std::make_unique<Marks>(box.min, width, height, visits_.words());
  }

  RevisitShare run() {
    for (std::size_t i = 0; i < keyframes_.size(); ++i) mark(i);
    RevisitShare out;
    for (std::size_t i = 0; i < keyframes_.size(); ++i) {
      const std::uint64_t* others = visits_.others(visits_.stretch_of(i));
      for (const slam::Point& hit : keyframes_[i]->hits) {
        const Vector2 p = poses_[i] * Vector2(hit.cast<double>());
        if (!seen(p, others)) continue;
        ++out.points;
        out.within += near(p, tolerance_m_, others, true) ? 1U : 0U;
      }
    }
    return out;
  }

 private:
  void mark(std::size_t i) {
    const std::size_t stretch = visits_.stretch_of(i);
    const Vector2 from = poses_[i] * Vector2(keyframes_[i]->sensor.cast<double>());
    const double step = 0.7 * map_.resolution_m();
    for (const slam::Point& hit : keyframes_[i]->hits) {
      const Vector2 to = poses_[i] * Vector2(hit.cast<double>());
      hit_->set(map_.cell_at(to), stretch);
      const double range = (to - from).norm();
      const Vector2 unit = (to - from) / std::max(range, 1e-9);
      for (double r = 0.0; r < range - kEnd_m; r += step)
        passed_->set(map_.cell_at(from + r * unit), stretch);
    }
  }

  [[nodiscard]] bool seen(const Vector2& p, const std::uint64_t* others) const {
    return passed_->any(map_.cell_at(p), others) || near(p, kPlaceRadius_m, others, false);
  }

  /// Is there a cell within the distance that one of the stretches hit (and that the map calls occupied)?
  [[nodiscard]] bool near(const Vector2& p, double distance_m, const std::uint64_t* others,
                          bool occupied) const {
    const int reach = static_cast<int>(std::ceil(distance_m / map_.resolution_m()));
    const grid::CellIndex centre = map_.cell_at(p);
    for (int y = -reach; y <= reach; ++y) {
      for (int x = -reach; x <= reach; ++x) {
        const grid::CellIndex cell{centre.x + x, centre.y + y};
        if ((map_.centre_of(cell) - p).norm() > distance_m) continue;
        if (!hit_->any(cell, others)) continue;
        if (!occupied || map_.state(cell) == grid::CellState::kOccupied) return true;
      }
    }
    return false;
  }

  std::span<const slam::KeyframePtr> keyframes_;
  std::span<const types::Se2> poses_;
  const grid::OccupancyGrid& map_;
  double tolerance_m_;
  Visits visits_;
  std::unique_ptr<Marks> hit_, passed_;
};

}  // namespace

RevisitShare revisit_share(std::span<const slam::KeyframePtr> keyframes, std::span<const types::Se2> poses,
                           const grid::OccupancyGrid& map, double tolerance_m) {
  return Counter(keyframes, poses, map, tolerance_m).run();
}

}  // namespace topo::bench
