// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/grid/wavefront.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>

namespace topo::grid {
namespace {

constexpr std::uint8_t kNoStep = 255;
constexpr float kUnreached = std::numeric_limits<float>::infinity();

/// What a metre costs by clearance.
class Crowding {
 public:
  explicit Crowding(const TravelRules& rules)
      : preferred_m_(static_cast<float>(rules.preferred_m)),
        per_m_(rules.preferred_m > rules.radius_m
                   ? static_cast<float>(rules.crowding / (rules.preferred_m - rules.radius_m))
                   : 0.0F) {}
  [[nodiscard]] float at(float clearance_m) const {
    return 1.0F + per_m_ * std::max(0.0F, preferred_m_ - clearance_m);
  }

 private:
  float preferred_m_;
  float per_m_;
};

/// Cells in the order of their cost, to within one bucket. No step costs less than a bucket is wide, so the
/// cells of one bucket cannot make each other cheaper, and each is final when its bucket's turn comes (Dial
/// 1969; Denardo and Fox 1979). No step costs more than the ring is long.
class BucketQueue {
 public:
  struct Entry {
    std::uint32_t index;
    float cost_m;
  };

  BucketQueue(float step_min_m, float step_max_m)
      : buckets_per_m_(1.0F / step_min_m),
        ring_(std::bit_ceil(static_cast<std::size_t>(std::ceil(step_max_m / step_min_m)) + 2)) {}

  void push(std::uint32_t index, float cost_m) {
    ring_[static_cast<std::size_t>(cost_m * buckets_per_m_) & (ring_.size() - 1)].push_back({index, cost_m});
    ++size_;
  }

  /// Calls f(Entry) until the queue is empty; f may push.
  template <class F>
  void drain(F&& f) {
    for (std::size_t turn = 0; size_ > 0; turn = (turn + 1) & (ring_.size() - 1)) {
      std::vector<Entry>& bucket = ring_[turn];
      // Rounding may put a new entry into the bucket at hand: it grows while it is read.
      for (std::size_t i = 0; i < bucket.size(); ++i) f(Entry(bucket[i]));
      size_ -= bucket.size();
      bucket.clear();
    }
  }

 private:
  float buckets_per_m_;
  std::vector<std::vector<Entry>> ring_;
  std::size_t size_ = 0;
};

double distance_m(const DenseMap& map, CellIndex a, CellIndex b) {
  return std::hypot(a.x - b.x, a.y - b.y) * map.resolution_m;
}

/// The cells around the start that the robot may use in order to leave, though they are too near to
/// something.
class StartRegion {
 public:
  StartRegion(const DenseMap& map, std::span<const float> clearance_m, CellIndex start,
              const TravelRules& rules)
      : map_(map), clearance_m_(clearance_m), start_(start), rules_(rules) {
    const float here_m = clearance_m[map.index(start)];
    clearance_min_m_ = std::max(0.0F, here_m - static_cast<float>(map.resolution_m));
  }

  [[nodiscard]] bool allows(CellIndex cell) const {
    const std::size_t i = map_.index(cell);
    if (map_.cells[i] == CellState::kOccupied) return false;
    const double away_m = distance_m(map_, cell, start_);
    if (away_m <= rules_.radius_m) return true;
    if (map_.cells[i] != CellState::kFree) return false;
    return away_m <= rules_.start_m && clearance_m_[i] >= clearance_min_m_;
  }

  /// In cells to each side.
  [[nodiscard]] int reach() const {
    return static_cast<int>(std::max(rules_.radius_m, rules_.start_m) / map_.resolution_m) + 1;
  }

 private:
  const DenseMap& map_;
  std::span<const float> clearance_m_;
  CellIndex start_;
  const TravelRules& rules_;
  float clearance_min_m_;
};

class Wavefront {
 public:
  Wavefront(const DenseMap& map, std::span<const float> clearance_m, const TravelRules& rules)
      : map_(map),
        clearance_m_(clearance_m),
        crowding_(rules),
        radius_m_(static_cast<float>(rules.radius_m)),
        resolution_m_(static_cast<float>(map.resolution_m)),
        queue_(resolution_m_, resolution_m_ * std::numbers::sqrt2_v<float> * crowding_.at(0.0F)) {
    for (std::size_t i = 0; i < kNeighbours.size(); ++i) {
      offset_[i] = kNeighbours[i].y * std::ptrdiff_t{map.width()} + kNeighbours[i].x;
    }
  }

  TravelField run(CellIndex start, const TravelRules& rules) {
    field_.start = start;
    field_.cost_m.assign(map_.cells.size(), kUnreached);
    field_.step.assign(map_.cells.size(), kNoStep);
    if (!map_.contains(start)) return std::move(field_);
    const auto first = static_cast<std::uint32_t>(map_.index(start));
    if (!on_border(start)) {
      mark_border(kClosed);
      if (!open(first)) open_start_region(StartRegion(map_, clearance_m_, start, rules));
      queue_.push(first, field_.cost_m[first] = 0.0F);
      queue_.drain([&](BucketQueue::Entry entry) {
        if (entry.cost_m <= field_.cost_m[entry.index]) expand(entry);
      });
      mark_border(kUnreached);
      close_start_region();
    }
    field_.cost_m[first] = 0.0F;
    field_.step[first] = kNoStep;
    return std::move(field_);
  }

 private:
  // A cost that nothing is less than: the border is never entered, and nobody asks for it.
  static constexpr float kClosed = -1.0F;
  // In place of kNoStep before a cell of the start region is reached.
  static constexpr std::uint8_t kOpenAtStart = 254;

  [[nodiscard]] bool on_border(CellIndex c) const {
    return c.x == map_.box.min.x || c.x == map_.box.max.x || c.y == map_.box.min.y || c.y == map_.box.max.y;
  }

  void mark_border(float cost) {
    const auto width = static_cast<std::size_t>(map_.width()), size = field_.cost_m.size();
    std::fill_n(field_.cost_m.begin(), width, cost);
    std::fill_n(field_.cost_m.end() - static_cast<std::ptrdiff_t>(width), width, cost);
    for (std::size_t i = 0; i < size; i += width) field_.cost_m[i] = field_.cost_m[i + width - 1] = cost;
  }

  void open_start_region(const StartRegion& region) {
    for (int y = field_.start.y - region.reach(); y <= field_.start.y + region.reach(); ++y) {
      for (int x = field_.start.x - region.reach(); x <= field_.start.x + region.reach(); ++x) {
        const CellIndex cell{x, y};
        if (!map_.contains(cell) || !region.allows(cell)) continue;
        start_region_.push_back(map_.index(cell));
        field_.step[start_region_.back()] = kOpenAtStart;
      }
    }
  }

  void close_start_region() {
    for (const std::size_t i : start_region_) {
      if (field_.step[i] == kOpenAtStart) field_.step[i] = kNoStep;
    }
  }

  [[nodiscard]] bool open(std::size_t i) const {
    return (clearance_m_[i] >= radius_m_ && map_.cells[i] == CellState::kFree) || field_.step[i] != kNoStep;
  }

  [[nodiscard]] bool cuts_corner(std::size_t from, std::size_t direction) const {
    // Straight neighbours are one cell away: farther from everything, none of them is occupied.
    if (direction % 2 == 0 || clearance_m_[from] > 1.01F * resolution_m_) return false;
    const auto occupied = [&](std::size_t d) {
      return map_.cells[from + static_cast<std::size_t>(offset_[d % 8])] == CellState::kOccupied;
    };
    return occupied(direction - 1) || occupied(direction + 1);
  }

  void expand(BucketQueue::Entry entry) {
    const float here = crowding_.at(clearance_m_[entry.index]);
    for (std::size_t d = 0; d < kNeighbours.size(); ++d) {
      const std::size_t to = entry.index + static_cast<std::size_t>(offset_[d]);
      const float half_m = (d % 2 == 0 ? 0.5F : std::numbers::sqrt2_v<float> / 2.0F) * resolution_m_;
      if (field_.cost_m[to] <= entry.cost_m + 2.0F * half_m || !open(to)) continue;
      const float cost_m = entry.cost_m + half_m * (here + crowding_.at(clearance_m_[to]));
      if (cost_m >= field_.cost_m[to] || cuts_corner(entry.index, d)) continue;
      field_.cost_m[to] = cost_m;
      field_.step[to] = static_cast<std::uint8_t>((d + 4) % 8);
      queue_.push(static_cast<std::uint32_t>(to), cost_m);
    }
  }

  const DenseMap& map_;
  std::span<const float> clearance_m_;
  Crowding crowding_;
  float radius_m_;
  float resolution_m_;
  BucketQueue queue_;
  std::array<std::ptrdiff_t, 8> offset_{};
  std::vector<std::size_t> start_region_;
  TravelField field_;
};

/// Calls f for the cells of the square ring `distance` cells around c.
template <class F>
void for_ring(CellIndex c, int distance, F&& f) {
  if (distance == 0) return f(c);
  for (int i = -distance; i < distance; ++i) {
    f(CellIndex{c.x + i, c.y - distance});
    f(CellIndex{c.x + distance, c.y + i});
    f(CellIndex{c.x - i, c.y + distance});
    f(CellIndex{c.x - distance, c.y - i});
  }
}

/// How far a cell is from the box, along x or y; a double holds what 32 bits may not.
double cells_outside(const CellBox& box, CellIndex c) {
  const auto outside = [](double v, double low, double high) { return std::max({0.0, low - v, v - high}); };
  return std::max(outside(c.x, box.min.x, box.max.x), outside(c.y, box.min.y, box.max.y));
}

}  // namespace

TravelField travel_field(const DenseMap& map, std::span<const float> clearance_m, CellIndex start,
                         const TravelRules& rules) {
  return Wavefront(map, clearance_m, rules).run(start, rules);
}

std::vector<CellIndex> route_to(const DenseMap& map, const TravelField& field, CellIndex goal) {
  std::vector<CellIndex> route;
  if (!map.contains(goal) || std::isinf(field.cost_m[map.index(goal)])) return route;
  route.push_back(goal);
  for (std::uint8_t step = 0; (step = field.step[map.index(route.back())]) != kNoStep;) {
    const CellIndex here = route.back();
    route.push_back({here.x + kNeighbours[step].x, here.y + kNeighbours[step].y});
  }
  std::reverse(route.begin(), route.end());
  return route;
}

std::optional<CellIndex> nearest_reachable(const DenseMap& map, const TravelField& field, CellIndex goal,
                                           double within_m) {
  std::optional<CellIndex> best;
  if (map.box.empty() || cells_outside(map.box, goal) * map.resolution_m > within_m) return best;
  double best_m = within_m;
  float best_cost_m = kUnreached;
  const int side = std::max({std::abs(goal.x - map.box.min.x), std::abs(goal.x - map.box.max.x),
                             std::abs(goal.y - map.box.min.y), std::abs(goal.y - map.box.max.y)});
  for (int ring = 0; ring <= side && ring * map.resolution_m <= best_m; ++ring) {
    for_ring(goal, ring, [&](CellIndex cell) {
      if (!map.contains(cell)) return;
      const float cost_m = field.cost_m[map.index(cell)];
      const double away_m = distance_m(map, cell, goal);
      if (std::isinf(cost_m) || away_m > best_m || (away_m == best_m && cost_m >= best_cost_m)) return;
      best = cell;
      best_m = away_m;
      best_cost_m = cost_m;
    });
  }
  return best;
}

}  // namespace topo::grid
