// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/global_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace topo::slam {
namespace {

/// Maximum number of stored blocks: many more than the blocks that one peak excludes, so that the better half
/// of them contains all peaks that are requested.
constexpr std::size_t kPromisingMax = 1U << 16U;

/// A square of places for one heading of the robot, by its lower left cell.
struct MapNode {
  int rotation = 0;
  int x = 0, y = 0;
  int score = 0;
};

/// Equal scores are ordered by heading and cell: the result does not depend on the sort.
bool before(const MapNode& a, const MapNode& b) {
  if (a.score != b.score) return a.score > b.score;
  if (a.rotation != b.rotation) return a.rotation < b.rotation;
  return a.y != b.y ? a.y < b.y : a.x < b.x;
}
bool after(const MapNode& a, const MapNode& b) { return before(b, a); }

class MapSearcher {
 public:
  MapSearcher(const PlaceLevels& levels, const StandingRoom& room, std::span<const Point> points,
              const PeakSearch& wanted, const SearchParams& params)
      : levels_(levels), room_(room), wanted_(wanted) {
    const std::size_t most = std::min(static_cast<std::size_t>(params.points_max), PlaceBlocks::kPoints / 2);
    const std::size_t stride = std::max<std::size_t>(1, points.size() / most);
    std::vector<Point> used;
    for (std::size_t i = 0; i < points.size(); i += stride) used.push_back(points[i]);
    count_ = used.size();
    floor_ = least_ = units(wanted.score_min);
    const double cell = levels_.pyramid().cell_m();
    rotations_ = static_cast<int>(std::ceil(2.0 * std::numbers::pi * params.angle_reach_m / cell));
    cells_.reserve(count_ * static_cast<std::size_t>(rotations_));
    for (int r = 0; r < rotations_; ++r) rotate(used, angle_of(r));
  }

  std::vector<SearchHit> run() {
    std::vector<MapNode> roots = promising_roots();
    std::sort(roots.begin(), roots.end(), before);
    for (const MapNode& root : roots) {
      if (root.score <= floor_) break;
      look_through(root);
    }
    return peaks();
  }

 private:
  /// A score must be greater than this.
  [[nodiscard]] int units(double score) const {
    return static_cast<int>(std::ceil(score * 255.0 * static_cast<double>(count_))) - 1;
  }
  [[nodiscard]] double score_of(const MapNode& node) const {
    return node.score / (255.0 * static_cast<double>(count_));
  }
  [[nodiscard]] double angle_of(int rotation) const {
    return 2.0 * std::numbers::pi * rotation / rotations_ - std::numbers::pi;
  }
  /// Centre of the cell of a finest square.
  [[nodiscard]] types::Se2 pose_of(const MapNode& node) const {
    const Point& origin = levels_.pyramid().origin();
    const double cell = levels_.pyramid().cell_m();
    return {static_cast<double>(origin.x()) + (node.x + 0.5) * cell,
            static_cast<double>(origin.y()) + (node.y + 0.5) * cell,
            types::wrap_angle(angle_of(node.rotation))};
  }
  [[nodiscard]] std::span<const CellOffset> cells_of(const MapNode& node) const {
    return std::span(cells_).subspan(static_cast<std::size_t>(node.rotation) * count_, count_);
  }

  void rotate(std::span<const Point> points, double theta) {
    const double c = std::cos(theta), s = std::sin(theta), cell = levels_.pyramid().cell_m();
    for (const Point& p : points) {
      const double x = static_cast<double>(p.x()), y = static_cast<double>(p.y());
      cells_.push_back({static_cast<int>(std::floor((c * x - s * y) / cell + 0.5)),
                        static_cast<int>(std::floor((s * x + c * y) / cell + 0.5))});
    }
  }

  /// The widest squares, each with the score of its best square of the next level, which indicates the best
  /// places better than its own score.
  [[nodiscard]] std::vector<MapNode> promising_roots() const {
    constexpr int kWidth = 1 << PlaceLevels::kRoot;
    std::vector<MapNode> roots;
    for (int y = 0; y < room_.width(); y += kWidth) {
      for (int x = 0; x < room_.width(); x += kWidth) {
        if (!room_.any(PlaceLevels::kRoot, x, y)) continue;
        for (int r = 0; r < rotations_; ++r) {
          MapNode root{r, x, y, 0};
          if (!can_be_better(root)) continue;
          for (const MapNode& square : better_in(root, levels_.coarse(), PlaceBlocks::kSide))
            root.score = std::max(root.score, square.score);
          if (root.score > floor_) roots.push_back(root);
        }
      }
    }
    return roots;
  }

  /// Stops as soon as the root's score cannot exceed the floor.
  [[nodiscard]] bool can_be_better(const MapNode& root) const {
    int possible = 255 * static_cast<int>(count_);
    for (const CellOffset& cell : cells_of(root)) {
      possible -= 255 - levels_.pyramid().at(PlaceLevels::kRoot, cell.x + root.x, cell.y + root.y);
      if (possible <= floor_) return false;
    }
    return true;
  }

  /// The squares of a block, `step` cells wide, that score above the floor and contain standing room.
  [[nodiscard]] std::vector<MapNode> better_in(const MapNode& block, const PlaceBlocks& places,
                                               int step) const {
    const PlaceBlocks::Scores scores = places.score(cells_of(block), block.x, block.y);
    std::vector<MapNode> better;
    for (int i = 0; i < PlaceBlocks::kSide * PlaceBlocks::kSide; ++i) {
      const MapNode square{block.rotation, block.x + i % PlaceBlocks::kSide * step,
                           block.y + i / PlaceBlocks::kSide * step, scores[static_cast<std::size_t>(i)]};
      if (square.score > floor_ && room_.any(PlaceLevels::kCoarse, square.x, square.y))
        better.push_back(square);
    }
    return better;
  }

  /// The best place of a block that no peak excludes; its score is the floor when there is none.
  [[nodiscard]] MapNode best_in(const MapNode& block) const {
    MapNode best{block.rotation, block.x, block.y, floor_};
    for (const MapNode& place : better_in(block, levels_.fine(), 1)) {
      if (place.score > best.score && !is_excluded(pose_of(place))) best = place;
    }
    return best;
  }

  [[nodiscard]] bool is_excluded(const types::Se2& pose) const {
    return std::any_of(peaks_.begin(), peaks_.end(), [&](const SearchHit& peak) {
      const types::Se2& other = peak.T_map_base;
      return distance_m(pose, other) < wanted_.apart_m &&
             std::abs(types::wrap_angle(pose.theta_rad - other.theta_rad)) < wanted_.apart_rad;
    });
  }

  /// Stores the finest blocks that contain a place which may be a peak.
  void look_through(const MapNode& root) {
    std::vector<MapNode> squares = better_in(root, levels_.coarse(), PlaceBlocks::kSide);
    std::sort(squares.begin(), squares.end(), before);
    for (MapNode& square : squares) {
      if (square.score <= floor_) return;
      square.score = best_in(square).score;
      if (square.score <= floor_) continue;
      promising_.push_back(square);
      least_ = std::max(least_, units(wanted_.ratio * score_of(square)));
      floor_ = std::max(floor_, least_);
      if (promising_.size() == kPromisingMax) keep_better_half();
    }
  }

  /// Bounds the memory for a scan that fits everywhere (a single wall at close range).
  void keep_better_half() {
    const auto middle = promising_.begin() + kPromisingMax / 2;
    std::nth_element(promising_.begin(), middle, promising_.end(), before);
    promising_.erase(middle, promising_.end());
    floor_ = std::max(floor_, std::max_element(promising_.begin(), promising_.end(), before)->score);
  }

  /// Selects the peaks in order, each the best place that the earlier ones do not exclude.
  [[nodiscard]] std::vector<SearchHit> peaks() {
    floor_ = least_;
    std::make_heap(promising_.begin(), promising_.end(), after);
    while (!promising_.empty() && peaks_.size() < wanted_.count_max) {
      std::pop_heap(promising_.begin(), promising_.end(), after);
      MapNode& block = promising_.back();
      const MapNode best = best_in(block);
      if (best.score == block.score && best.score > floor_) peaks_.push_back({pose_of(best), score_of(best)});
      block.score = best.score;
      if (best.score > floor_)
        std::push_heap(promising_.begin(), promising_.end(), after);
      else
        promising_.pop_back();
    }
    return peaks_;
  }

  const PlaceLevels& levels_;
  const StandingRoom& room_;
  PeakSearch wanted_;
  std::vector<CellOffset> cells_;  ///< of all points, one direction after the other
  std::size_t count_ = 0;
  int rotations_ = 0;
  int least_ = 0;                   ///< a score up to this is not a peak
  int floor_ = 0;                   ///< squares with a score up to this are skipped
  std::vector<MapNode> promising_;  ///< finest blocks with the scores of their best places
  std::vector<SearchHit> peaks_;
};

}  // namespace

PlaceLevels::PlaceLevels(const SurfelMap& map, SearchParams params)
    : pyramid_(map, (params.depth = kRoot, params)), fine_(pyramid_, 0), coarse_(pyramid_, kCoarse) {}

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
    // The nearer neighbour on either axis: covers the space between the rays of a sparse fan.
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

std::vector<SearchHit> search_everywhere(const PlaceLevels& levels, const StandingRoom& room,
                                         std::span<const Point> points, const PeakSearch& wanted,
                                         const SearchParams& params) {
  if (points.empty()) return {};
  return MapSearcher(levels, room, points, wanted, params).run();
}

}  // namespace topo::slam
