// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/grid/wavefront.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>

#include "core/grid/bucket_queue.hpp"

namespace topo::grid {
namespace {

constexpr std::uint8_t kNoStep = 255;
constexpr float kUnreached = std::numeric_limits<float>::infinity();

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

}  // namespace

class TravelSearch::Impl {
 public:
  void begin(const DenseMap& map, std::span<const float> clearance_m, CellIndex start,
             const TravelRules& rules, TravelField& field) {
    map_ = &map;
    clearance_m_ = clearance_m;
    crowding_ = Crowding(rules);
    resolution_m_ = static_cast<float>(map.resolution_m);
    field_ = &field;
    queue_.reset(resolution_m_, resolution_m_ * std::numbers::sqrt2_v<float> * crowding_.at(0.0F));
    for (std::size_t i = 0; i < kNeighbours.size(); ++i) {
      offset_[i] = kNeighbours[i].y * std::ptrdiff_t{map.width()} + kNeighbours[i].x;
    }
    prepare(start, rules);
  }

  void settle(float bound_m) {
    if (complete_) return;
    if (!may_pause_) bound_m = kUnreached;
    complete_ = queue_.drain(bound_m, [&](BucketQueue::Entry entry) {
      if (entry.cost_m <= field_->cost_m[entry.index]) expand(entry);
    });
    if (!complete_) flood();
  }

  [[nodiscard]] float settled_m() const { return complete_ ? kUnreached : queue_.next_m(); }

 private:
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

  void prepare(CellIndex start, const TravelRules& rules) {
    field_->start = start;
    field_->cost_m.assign(map_->cells.size(), kUnreached);
    field_->step.assign(map_->cells.size(), kNoStep);
    complete_ = true;
    if (!map_->contains(start)) return;
    const auto first = static_cast<std::uint32_t>(map_->index(start));
    field_->cost_m[first] = 0.0F;
    if (on_border(start)) return;
    price_cells(static_cast<float>(rules.radius_m));
    const bool leaves = metre_cost_[first] == kUnreached;
    if (leaves) open_start_region(StartRegion(*map_, clearance_m_, start, rules));
    close_border();
    // Corners are cut nowhere else: the flood need not ask.
    may_pause_ = !leaves && !is_near_something(static_cast<float>(rules.radius_m));
    queue_.push(first, 0.0F);
    complete_ = false;
  }

  [[nodiscard]] bool on_border(CellIndex c) const {
    return c.x == map_->box.min.x || c.x == map_->box.max.x || c.y == map_->box.min.y ||
           c.y == map_->box.max.y;
  }

  /// What a metre costs in every cell, so that a step asks one array.
  void price_cells(float radius_m) {
    metre_cost_.resize(map_->cells.size());
    const Crowding crowding = crowding_;
    const CellState* cells = map_->cells.data();
    const float* clearance_m = clearance_m_.data();
    float* const out = metre_cost_.data();
    for (std::size_t i = 0; i < metre_cost_.size(); ++i) {
      const float open = crowding.at(clearance_m[i]);
      const bool closed = (clearance_m[i] < radius_m) | (cells[i] != CellState::kFree);
      out[i] = closed ? kUnreached : open;
    }
  }

  /// The outermost cells are never entered: neighbours of all others are in the array.
  void close_border() {
    const auto width = static_cast<std::size_t>(map_->width()), size = metre_cost_.size();
    std::fill_n(metre_cost_.begin(), width, kUnreached);
    std::fill_n(metre_cost_.end() - static_cast<std::ptrdiff_t>(width), width, kUnreached);
    for (std::size_t i = 0; i < size; i += width) metre_cost_[i] = metre_cost_[i + width - 1] = kUnreached;
  }

  void open_start_region(const StartRegion& region) {
    for (int y = field_->start.y - region.reach(); y <= field_->start.y + region.reach(); ++y) {
      for (int x = field_->start.x - region.reach(); x <= field_->start.x + region.reach(); ++x) {
        const CellIndex cell{x, y};
        if (!map_->contains(cell) || !region.allows(cell)) continue;
        const std::size_t i = map_->index(cell);
        metre_cost_[i] = crowding_.at(clearance_m_[i]);
      }
    }
  }

  /// Straight neighbours are one cell away: farther from everything, none of them is occupied.
  [[nodiscard]] bool is_near_something(float clearance_m) const {
    return clearance_m <= 1.01F * resolution_m_;
  }

  [[nodiscard]] bool cuts_corner(std::size_t from, std::size_t direction) const {
    if (direction % 2 == 0 || !is_near_something(clearance_m_[from])) return false;
    const auto occupied = [&](std::size_t d) {
      return map_->cells[from + static_cast<std::size_t>(offset_[d % 8])] == CellState::kOccupied;
    };
    return occupied(direction - 1) || occupied(direction + 1);
  }

  void expand(BucketQueue::Entry entry) {
    const float here = crowding_.at(clearance_m_[entry.index]);
    const float straight_m = 0.5F * resolution_m_;
    const float diagonal_m = std::numbers::sqrt2_v<float> / 2.0F * resolution_m_;
    float* const cost = field_->cost_m.data() + entry.index;
    const float* const metre = metre_cost_.data() + entry.index;
    for (std::size_t d = 0; d < kNeighbours.size(); ++d) {
      const std::ptrdiff_t to = offset_[d];
      const float cost_m = entry.cost_m + (d % 2 == 0 ? straight_m : diagonal_m) * (here + metre[to]);
      if (cost_m >= cost[to] || cuts_corner(entry.index, d)) continue;
      cost[to] = cost_m;
      field_->step[entry.index + static_cast<std::size_t>(to)] = static_cast<std::uint8_t>((d + 4) % 8);
      queue_.push(static_cast<std::uint32_t>(static_cast<std::ptrdiff_t>(entry.index) + to), cost_m);
    }
  }

  /// Marks what will be reached, run by run of a row.
  void flood() {
    seeds_.clear();
    queue_.for_each([&](BucketQueue::Entry entry) { seeds_.push_back(entry.index); });
    const auto width = static_cast<std::size_t>(map_->width());
    while (!seeds_.empty()) {
      const std::size_t seed = seeds_.back();
      seeds_.pop_back();
      std::size_t first = seed, end = seed + 1;
      while (is_new(first - 1)) field_->cost_m[--first] = TravelField::kLater;
      while (is_new(end)) field_->cost_m[end++] = TravelField::kLater;
      add_seeds(first - width - 1, end - width + 1);
      add_seeds(first + width - 1, end + width + 1);
    }
  }

  /// The first new cell of each run in a piece of a row.
  void add_seeds(std::size_t from, std::size_t end) {
    for (std::size_t i = from; i < end; ++i) {
      if (!is_new(i)) continue;
      field_->cost_m[i] = TravelField::kLater;
      seeds_.push_back(static_cast<std::uint32_t>(i));
      while (i + 1 < end && is_new(i + 1)) ++i;
    }
  }

  [[nodiscard]] bool is_new(std::size_t i) const {
    return field_->cost_m[i] == kUnreached && metre_cost_[i] != kUnreached;
  }

  const DenseMap* map_ = nullptr;
  std::span<const float> clearance_m_;
  Crowding crowding_{TravelRules{}};
  float resolution_m_ = 0.0F;
  BucketQueue queue_;
  std::vector<float> metre_cost_;  ///< of every cell; infinity where the robot cannot be
  TravelField* field_ = nullptr;
  std::array<std::ptrdiff_t, 8> offset_{};
  std::vector<std::uint32_t> seeds_;
  bool complete_ = true, may_pause_ = false;
};

namespace {

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
  TravelField field;
  TravelSearch search;
  search.begin(map, clearance_m, start, rules, field);
  search.settle(HUGE_VAL);
  return field;
}

TravelSearch::TravelSearch() : impl_(std::make_unique<Impl>()) {}
TravelSearch::~TravelSearch() = default;

void TravelSearch::begin(const DenseMap& map, std::span<const float> clearance_m, CellIndex start,
                         const TravelRules& rules, TravelField& field) {
  impl_->begin(map, clearance_m, start, rules, field);
}

void TravelSearch::settle(double bound_m) { impl_->settle(static_cast<float>(bound_m)); }

double TravelSearch::settled_m() const { return static_cast<double>(impl_->settled_m()); }

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
