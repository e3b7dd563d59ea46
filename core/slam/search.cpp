// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/search.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace topo::slam {
namespace {

/// One rotation of the scan, as cells relative to the search centre.
struct Rotation {
  double theta_rad = 0.0;
  std::vector<CellOffset> cells;
};

/// A square of translations: lower corner in cells, 2^level wide.
struct WindowNode {
  std::size_t rotation = 0;
  int x = 0, y = 0;
  int level = 0;
  int score = 0;
};

class WindowSearcher {
 public:
  WindowSearcher(const LikelihoodPyramid& pyramid, std::span<const Point> points, const types::Se2& centre,
                 const SearchWindow& window, const SearchParams& params,
                 const std::optional<Exclusion>& exclusion)
      : pyramid_(pyramid), centre_(centre), exclusion_(exclusion) {
    half_cells_ = std::max(1, static_cast<int>(std::ceil(window.half_m / pyramid.cell_m())));
    const std::size_t stride =
        std::max<std::size_t>(1, points.size() / static_cast<std::size_t>(params.points_max));
    float reach = 1.0F;
    std::vector<Point> used;
    for (std::size_t i = 0; i < points.size(); i += stride) {
      used.push_back(points[i]);
      reach = std::max(reach, points[i].norm());
    }
    count_ = std::max<std::size_t>(1, used.size());
    const double step =
        std::max(pyramid.cell_m() / std::min(params.angle_reach_m, static_cast<double>(reach)),
                 params.angle_step_min_rad);
    const int steps = static_cast<int>(std::ceil(window.half_rad / step));
    for (int k = -steps; k <= steps; ++k) rotations_.push_back(rotate(used, centre.theta_rad + k * step));
  }

  std::optional<SearchHit> run(double score_min) {
    best_score_ = static_cast<int>(std::ceil(score_min * 255.0 * static_cast<double>(count_))) - 1;
    int level = pyramid_.depth();
    while (level > 0 && (1 << level) > half_cells_) --level;
    std::vector<WindowNode> nodes;
    const int width = 1 << level;
    for (std::size_t r = 0; r < rotations_.size(); ++r) {
      for (int y = -half_cells_; y <= half_cells_; y += width) {
        for (int x = -half_cells_; x <= half_cells_; x += width) add(nodes, {r, x, y, level, 0});
      }
    }
    descend(nodes);
    if (!found_) return std::nullopt;
    const double theta = rotations_[best_.rotation].theta_rad;
    return SearchHit{{centre_.x_m + best_.x * pyramid_.cell_m(), centre_.y_m + best_.y * pyramid_.cell_m(),
                      types::wrap_angle(theta)},
                     best_score_ / (255.0 * static_cast<double>(count_))};
  }

 private:
  Rotation rotate(std::span<const Point> points, double theta) const {
    Rotation rotation{theta, {}};
    rotation.cells.reserve(points.size());
    const double c = std::cos(theta), s = std::sin(theta);
    const double ox = centre_.x_m - static_cast<double>(pyramid_.origin().x());
    const double oy = centre_.y_m - static_cast<double>(pyramid_.origin().y());
    for (const Point& p : points) {
      const double px = static_cast<double>(p.x()), py = static_cast<double>(p.y());
      rotation.cells.push_back({static_cast<int>(std::floor((c * px - s * py + ox) / pyramid_.cell_m())),
                                static_cast<int>(std::floor((s * px + c * py + oy) / pyramid_.cell_m()))});
    }
    return rotation;
  }

  void add(std::vector<WindowNode>& nodes, WindowNode node) const {
    if (node.x > half_cells_ || node.y > half_cells_) return;
    if (node.level == 0 && excluded(node)) return;
    int score = 0;
    for (const CellOffset& cell : rotations_[node.rotation].cells) {
      score += pyramid_.at(node.level, cell.x + node.x, cell.y + node.y);
    }
    node.score = score;
    if (score > best_score_) nodes.push_back(node);
  }

  bool excluded(const WindowNode& node) const {
    if (!exclusion_) return false;
    const double x = centre_.x_m + node.x * pyramid_.cell_m(), y = centre_.y_m + node.y * pyramid_.cell_m();
    const double turn = types::wrap_angle(rotations_[node.rotation].theta_rad - exclusion_->centre.theta_rad);
    return std::hypot(x - exclusion_->centre.x_m, y - exclusion_->centre.y_m) < exclusion_->radius_m &&
           std::abs(turn) < exclusion_->radius_rad;
  }

  void descend(std::vector<WindowNode>& nodes) {
    // Equal scores are ordered by rotation and cell, so that the result does not depend on the sort.
    std::sort(nodes.begin(), nodes.end(), [](const WindowNode& a, const WindowNode& b) {
      if (a.score != b.score) return a.score > b.score;
      if (a.rotation != b.rotation) return a.rotation < b.rotation;
      return a.y != b.y ? a.y < b.y : a.x < b.x;
    });
    for (const WindowNode& node : nodes) {
      if (node.score <= best_score_) return;
      if (node.level == 0) {
        best_ = node;
        best_score_ = node.score;
        found_ = true;
        return;
      }
      const int half = 1 << (node.level - 1);
      std::vector<WindowNode> children;
      children.reserve(4);
      for (const auto& [dx, dy] : {std::pair{0, 0}, {half, 0}, {0, half}, {half, half}}) {
        add(children, {node.rotation, node.x + dx, node.y + dy, node.level - 1, 0});
      }
      descend(children);
    }
  }

  const LikelihoodPyramid& pyramid_;
  types::Se2 centre_;
  std::optional<Exclusion> exclusion_;
  std::vector<Rotation> rotations_;
  std::size_t count_ = 1;
  int half_cells_ = 1;
  WindowNode best_;
  int best_score_ = 0;
  bool found_ = false;
};

/// exp(-d^2 / 2 sigma^2) in 255ths, from a table indexed by d^2.
class Kernel {
 public:
  Kernel(double reach_m, double sigma_m) {
    const double reach2 = 2.0 * reach_m * reach_m;
    per_entry_ = static_cast<float>(kEntries / reach2);
    for (std::size_t i = 0; i < kEntries; ++i) {
      const double d2 = (static_cast<double>(i) + 0.5) * reach2 / kEntries;
      table_[i] = static_cast<std::uint8_t>(255.0 * std::exp(-0.5 * d2 / (sigma_m * sigma_m)));
    }
  }
  [[nodiscard]] std::uint8_t at(float distance2) const {
    return table_[std::min(kEntries - 1, static_cast<std::size_t>(distance2 * per_entry_))];
  }

 private:
  static constexpr std::size_t kEntries = 2048;  ///< finer than the steps of the table's values, 1 / 255
  std::array<std::uint8_t, kEntries> table_{};
  float per_entry_;
};

}  // namespace

LikelihoodPyramid::LikelihoodPyramid(const SurfelMap& map, const SearchParams& params)
    : cell_m_(params.cell_m),
      origin_(map.origin()),
      width_(static_cast<int>(std::ceil(map.width_m() / params.cell_m))) {
  const int reach = static_cast<int>(std::ceil(params.kernel_sigmas * params.kernel_sigma_m / cell_m_));
  levels_.resize(static_cast<std::size_t>(params.depth) + 1);
  draw(map.surfels(), reach, params.kernel_sigma_m);
  for (std::size_t h = 1; h < levels_.size(); ++h) coarsen(h);
}

void LikelihoodPyramid::draw(std::span<const Surfel> surfels, int reach, double sigma_m) {
  levels_[0].assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(width_), 0);
  const auto cell = static_cast<float>(cell_m_);
  const Kernel kernel(reach * cell_m_ + cell_m_, sigma_m);
  for (const Surfel& surfel : surfels) {
    const Point local = surfel.position - origin_;
    const int cx = static_cast<int>(local.x() / cell), cy = static_cast<int>(local.y() / cell);
    for (int y = std::max(0, cy - reach); y <= std::min(width_ - 1, cy + reach); ++y) {
      const float dy = (static_cast<float>(y) + 0.5F) * cell - local.y();
      std::uint8_t* row = &levels_[0][static_cast<std::size_t>(y) * static_cast<std::size_t>(width_)];
      for (int x = std::max(0, cx - reach); x <= std::min(width_ - 1, cx + reach); ++x) {
        const float dx = (static_cast<float>(x) + 0.5F) * cell - local.x();
        row[x] = std::max(row[x], kernel.at(dx * dx + dy * dy));
      }
    }
  }
}

void LikelihoodPyramid::coarsen(std::size_t level) {
  const std::vector<std::uint8_t>& below = levels_[level - 1];
  std::vector<std::uint8_t>& above = levels_[level];
  above = below;
  const auto width = static_cast<std::size_t>(width_);
  const std::size_t step = std::size_t{1} << (level - 1);
  // Two passes of plain maxima, which the compiler vectorises to sixteen cells per instruction.
  for (std::size_t y = 0; y < width && step < width; ++y) {
    const std::uint8_t* from = &below[y * width];
    std::uint8_t* to = &above[y * width];
    for (std::size_t x = 0; x < width - step; ++x) to[x] = std::max(from[x], from[x + step]);
  }
  for (std::size_t y = 0; y + step < width; ++y) {
    std::uint8_t* to = &above[y * width];
    const std::uint8_t* next = &above[(y + step) * width];
    for (std::size_t x = 0; x < width; ++x) to[x] = std::max(to[x], next[x]);
  }
}

std::uint8_t LikelihoodPyramid::clipped(int level, int x, int y) const {
  // A square that begins outside to the lower left may extend into the window: its maximum is bounded by the
  // square of the same size that begins at the border.
  const int width = 1 << level;
  if (x >= width_ || y >= width_ || x <= -width || y <= -width) return 0;
  return levels_[static_cast<std::size_t>(level)]
                [static_cast<std::size_t>(std::max(y, 0) * width_ + std::max(x, 0))];
}

std::optional<SearchHit> search(const LikelihoodPyramid& pyramid, std::span<const Point> points,
                                const types::Se2& centre, const SearchWindow& window, double score_min,
                                const SearchParams& params, const std::optional<Exclusion>& exclusion) {
  if (points.empty()) return std::nullopt;
  return WindowSearcher(pyramid, points, centre, window, params, exclusion).run(score_min);
}

}  // namespace topo::slam
