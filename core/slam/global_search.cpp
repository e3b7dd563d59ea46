// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/global_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace topo::slam {
namespace {

constexpr double kReach_m = 10.0;  ///< a step of the angle moves a point here by one cell

/// A square of places for one direction of the robot: lower left cell, 2^level wide.
struct MapNode {
  int rotation = 0;
  int x = 0, y = 0;
  int level = 0;
  int score = 0;
};

/// Equal scores are taken in the order of direction and cell: the result does not depend on the sort.
bool before(const MapNode& a, const MapNode& b) {
  if (a.score != b.score) return a.score > b.score;
  if (a.rotation != b.rotation) return a.rotation < b.rotation;
  return a.y != b.y ? a.y < b.y : a.x < b.x;
}

class MapSearcher {
 public:
  MapSearcher(const LikelihoodPyramid& pyramid, const StandingRoom& room, std::span<const Point> points,
              Exclusions excluded, const SearchParams& params)
      : pyramid_(pyramid), room_(room), excluded_(excluded) {
    const std::size_t stride =
        std::max<std::size_t>(1, points.size() / static_cast<std::size_t>(params.points_max));
    std::vector<Point> used;
    for (std::size_t i = 0; i < points.size(); i += stride) used.push_back(points[i]);
    count_ = used.size();
    rotations_ = static_cast<int>(std::ceil(2.0 * std::numbers::pi * kReach_m / pyramid.cell_m()));
    cells_.reserve(count_ * static_cast<std::size_t>(rotations_));
    for (int r = 0; r < rotations_; ++r) rotate(used, angle_of(r));
  }

  std::optional<SearchHit> run(double score_min) {
    best_.score = static_cast<int>(std::ceil(score_min * 255.0 * static_cast<double>(count_))) - 1;
    const int level = pyramid_.depth(), width = 1 << level;
    std::vector<MapNode> nodes;
    for (int y = 0; y < room_.width(); y += width) {
      for (int x = 0; x < room_.width(); x += width) {
        if (!room_.any(level, x, y)) continue;
        for (int r = 0; r < rotations_; ++r) add(nodes, {r, x, y, level, 0});
      }
    }
    descend(nodes);
    if (!found_) return std::nullopt;
    return SearchHit{pose_of(best_), best_.score / (255.0 * static_cast<double>(count_))};
  }

 private:
  [[nodiscard]] double angle_of(int rotation) const {
    return 2.0 * std::numbers::pi * rotation / rotations_ - std::numbers::pi;
  }
  /// The middle of a finest square's cell.
  [[nodiscard]] types::Se2 pose_of(const MapNode& node) const {
    const double cell = pyramid_.cell_m();
    return {static_cast<double>(pyramid_.origin().x()) + (node.x + 0.5) * cell,
            static_cast<double>(pyramid_.origin().y()) + (node.y + 0.5) * cell,
            types::wrap_angle(angle_of(node.rotation))};
  }

  void rotate(std::span<const Point> points, double theta) {
    const double c = std::cos(theta), s = std::sin(theta), cell = pyramid_.cell_m();
    for (const Point& p : points) {
      const double x = static_cast<double>(p.x()), y = static_cast<double>(p.y());
      cells_.push_back({static_cast<int>(std::floor((c * x - s * y) / cell + 0.5)),
                        static_cast<int>(std::floor((s * x + c * y) / cell + 0.5))});
    }
  }

  /// Keeps the node when it can be better than the best; looks at no more points than that takes.
  void add(std::vector<MapNode>& nodes, MapNode node) const {
    const CellOffset* cells = &cells_[static_cast<std::size_t>(node.rotation) * count_];
    int possible = 255 * static_cast<int>(count_);
    for (std::size_t i = 0; i < count_; ++i) {
      possible -= 255 - pyramid_.at(node.level, cells[i].x + node.x, cells[i].y + node.y);
      if (possible <= best_.score) return;
    }
    node.score = possible;
    if (node.level == 0 && is_excluded(pose_of(node))) return;
    nodes.push_back(node);
  }

  [[nodiscard]] bool is_excluded(const types::Se2& pose) const {
    return std::any_of(excluded_.begin(), excluded_.end(), [&](const Exclusion& e) {
      return std::hypot(pose.x_m - e.centre.x_m, pose.y_m - e.centre.y_m) < e.radius_m &&
             std::abs(types::wrap_angle(pose.theta_rad - e.centre.theta_rad)) < e.radius_rad;
    });
  }

  void descend(std::vector<MapNode>& nodes) {
    std::sort(nodes.begin(), nodes.end(), before);
    for (const MapNode& node : nodes) {
      if (node.score <= best_.score) return;
      if (node.level == 0) {
        best_ = node;
        found_ = true;
        return;
      }
      const int level = node.level - 1, half = 1 << level;
      std::vector<MapNode> children;
      children.reserve(4);
      for (const auto& [dx, dy] : {std::pair{0, 0}, {half, 0}, {0, half}, {half, half}}) {
        if (room_.any(level, node.x + dx, node.y + dy))
          add(children, {node.rotation, node.x + dx, node.y + dy, level, 0});
      }
      descend(children);
    }
  }

  const LikelihoodPyramid& pyramid_;
  const StandingRoom& room_;
  Exclusions excluded_;
  std::vector<CellOffset> cells_;  ///< of all points in one direction after the other
  std::size_t count_ = 0;
  int rotations_ = 0;
  MapNode best_;
  bool found_ = false;
};

}  // namespace

StandingRoom::StandingRoom(const LikelihoodPyramid& pyramid, double width_m)
    : width_(static_cast<int>(std::ceil(width_m / pyramid.cell_m()))),
      origin_(pyramid.origin()),
      square_m_(pyramid.cell_m() * (1 << kFinest)) {
  for (int level = kFinest; level <= std::max(kFinest, pyramid.depth()); ++level) {
    side_.push_back((width_ >> level) + 1);
    levels_.emplace_back(static_cast<std::size_t>(side_.back()) * static_cast<std::size_t>(side_.back()), 0);
  }
}

void StandingRoom::mark(int x, int y) {
  const int side = side_.front();
  if (x < 0 || y < 0 || x >= side || y >= side) return;
  levels_
      .front()[static_cast<std::size_t>(y) * static_cast<std::size_t>(side) + static_cast<std::size_t>(x)] =
      1;
}

void StandingRoom::add_ray(const Point& from, const Point& to) {
  const auto square = static_cast<float>(square_m_);
  const Point way = to - from;
  const int steps = static_cast<int>(way.norm() / square) + 1;
  for (int i = 0; i <= steps; ++i) {
    const Point at = (from + way * (static_cast<float>(i) / static_cast<float>(steps)) - origin_) / square;
    const int x = static_cast<int>(std::floor(at.x())), y = static_cast<int>(std::floor(at.y()));
    mark(x, y);
    // The nearer half's neighbour on either axis: what lies beside a sparse fan of rays.
    mark(at.x() - std::floor(at.x()) < 0.5F ? x - 1 : x + 1, y);
    mark(x, at.y() - std::floor(at.y()) < 0.5F ? y - 1 : y + 1);
  }
}

void StandingRoom::close() {
  for (std::size_t k = 1; k < levels_.size(); ++k) {
    const auto side = static_cast<std::size_t>(side_[k - 1]), half = static_cast<std::size_t>(side_[k]);
    for (std::size_t y = 0; y < side; ++y) {
      for (std::size_t x = 0; x < side; ++x) {
        if (levels_[k - 1][y * side + x] != 0) levels_[k][y / 2 * half + x / 2] = 1;
      }
    }
  }
}

bool StandingRoom::any(int level, int x, int y) const {
  if (x >= width_ || y >= width_) return false;
  const int shift = std::max(level, kFinest);
  const auto k = static_cast<std::size_t>(shift - kFinest);
  return levels_[k][static_cast<std::size_t>(y >> shift) * static_cast<std::size_t>(side_[k]) +
                    static_cast<std::size_t>(x >> shift)] != 0;
}

std::optional<SearchHit> search_everywhere(const LikelihoodPyramid& pyramid, const StandingRoom& room,
                                           std::span<const Point> points, double score_min,
                                           Exclusions excluded, const SearchParams& params) {
  if (points.empty()) return std::nullopt;
  return MapSearcher(pyramid, room, points, excluded, params).run(score_min);
}

}  // namespace topo::slam
