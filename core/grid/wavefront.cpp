// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/grid/wavefront.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <numbers>

#include "core/grid/bucket_queue.hpp"
#include "core/grid/free_runs.hpp"
#include "core/grid/joined_runs.hpp"
#include "core/types/invariant.hpp"

namespace topo::grid {
namespace {

/// A cell's three neighbours in one row and a fourth cell, in vector instructions of every machine.
using Row = float __attribute__((vector_size(16)));
using Flags = std::int32_t __attribute__((vector_size(16)));

Row row_at(const float* from) {
  Row row;
  std::memcpy(&row, from, sizeof row);
  return row;
}

/// The rows below, beside and above a cell. The fourth cell follows the three; in the row above it precedes
/// them. No row then reaches beyond the array, provided that the cell is not on its border.
struct RowShape {
  int dy;
  int first_dx;
  Flags directions;  ///< the bit of each neighbour's index in kNeighbours
};
constexpr std::array<RowShape, 3> kRows{{{-1, -1, {1 << 5, 1 << 6, 1 << 7, 0}},
                                         {0, -1, {1 << 4, 0, 1 << 0, 0}},
                                         {1, -2, {0, 1 << 3, 1 << 2, 1 << 1}}}};

constexpr std::uint8_t kNoStep = 255;
constexpr float kUnreached = std::numeric_limits<float>::infinity();

double distance_m(const DenseMap& map, CellIndex a, CellIndex b) {
  return std::hypot(a.x - b.x, a.y - b.y) * map.resolution_m;
}

/// Cells around the start that the robot may use to leave it, although their clearance is too small.
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

  /// Extent of the region in cells to each side.
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
    near_cost_ = crowding_.at(kNearCells * resolution_m_);
    field_ = &field;
    queue_.reset(resolution_m_, resolution_m_ * std::numbers::sqrt2_v<float> * crowding_.at(0.0F));
    const float straight_m = 0.5F * resolution_m_;
    const float diagonal_m = std::numbers::sqrt2_v<float> / 2.0F * resolution_m_;
    half_step_m_ = {Row{diagonal_m, straight_m, diagonal_m, 0.0F}, Row{straight_m, 0.0F, straight_m, 0.0F},
                    Row{0.0F, diagonal_m, straight_m, diagonal_m}};
    for (std::size_t i = 0; i < kNeighbours.size(); ++i) {
      offset_[i] = kNeighbours[i].y * std::ptrdiff_t{map.width()} + kNeighbours[i].x;
    }
    prepare(start, rules);
  }

  void advance(float bound_m) {
    if (complete_) return;
    if (!may_pause_) bound_m = kUnreached;
    complete_ = queue_.drain(bound_m, [&](BucketQueue::Entry entry) {
      if (entry.cost_m <= field_->cost_m[entry.index]) expand(entry);
    });
  }

  void settle(float bound_m) {
    advance(bound_m);
    if (!complete_) mark_later();
  }

  [[nodiscard]] float settled_m() const { return complete_ ? kUnreached : queue_.next_m(); }

 private:
  /// A cell with more clearance than this has no occupied straight neighbour, to within rounding.
  static constexpr float kNearCells = 1.01F;

  /// Inflation: the cost of a metre as a function of the clearance.
  class Crowding {
   public:
    explicit Crowding(const TravelRules& rules)
        : preferred_m_(static_cast<float>(rules.preferred_m)),
          per_m_(rules.preferred_m > rules.radius_m
                     ? static_cast<float>(rules.crowding / (rules.preferred_m - rules.radius_m))
                     : 0.0F),
          radius_m_(static_cast<float>(rules.radius_m)),
          tightness_(static_cast<float>(rules.tightness)) {}
    [[nodiscard]] float at(float clearance_m) const {
      return leaving_at(clearance_m) + (clearance_m < radius_m_ ? tightness_ : 0.0F);
    }
    /// For a robot that already stands there.
    [[nodiscard]] float leaving_at(float clearance_m) const {
      return 1.0F + per_m_ * std::max(0.0F, preferred_m_ - clearance_m);
    }

   private:
    float preferred_m_;
    float per_m_;
    float radius_m_, tightness_;
  };

  void prepare(CellIndex start, const TravelRules& rules) {
    clear_field();
    field_->start = start;
    field_->clearance_m = rules.tight_m < rules.radius_m ? clearance_m_ : std::span<const float>();
    field_->radius_m = static_cast<float>(rules.radius_m);
    complete_ = true;
    marked_ = false;
    if (!map_->contains(start)) return;
    const auto first = static_cast<std::uint32_t>(map_->index(start));
    field_->cost_m[first] = 0.0F;
    field_->written.push_back({first, first + 1});
    if (map_->is_on_border(start)) return;
    const auto tight_m = static_cast<float>(std::min(rules.tight_m, rules.radius_m));
    price_cells(tight_m);
    const bool leaves =
        metre_cost_[first] == kUnreached || clearance_m_[first] < static_cast<float>(rules.radius_m);
    if (leaves) open_start_region(StartRegion(*map_, clearance_m_, start, rules));
    metre_cost_[first] = crowding_.leaving_at(clearance_m_[first]);  // the robot stands there
    field_->written = priced_;
    // When a pause is allowed, no connection depends on a cut corner, and mark_later() need not check for
    // them.
    may_pause_ = !is_near_something(tight_m) && !(leaves && meets_at_corners());
    queue_.push(first, 0.0F);
    complete_ = false;
  }

  /// Clears only what the previous search wrote.
  void clear_field() {
    for (const CellRun& run : field_->written) {
      std::fill(field_->cost_m.begin() + run.first, field_->cost_m.begin() + run.end, kUnreached);
      std::fill(field_->step.begin() + run.first, field_->step.begin() + run.end, kNoStep);
    }
    field_->written.clear();
    field_->cost_m.resize(map_->cells.size(), kUnreached);
    field_->step.resize(map_->cells.size(), kNoStep);
  }

  /// Computes the cost of a metre for every free cell, so that a step reads one array. Most of a map is not
  /// free and costs nothing here. The outermost cells are never entered: the neighbours of all others are in
  /// the array.
  void price_cells(float tight_m) {
    for (const CellRun& run : priced_)
      std::fill(metre_cost_.begin() + run.first, metre_cost_.begin() + run.end, kUnreached);
    priced_.clear();
    metre_cost_.resize(map_->cells.size(), kUnreached);
    const auto width = static_cast<std::size_t>(map_->width());
    for (std::size_t row = width; row + width < map_->cells.size(); row += width) {
      for_each_free_run(map_->cells, row + 1, row + width - 1, [&](std::size_t first, std::size_t end) {
        price_run(first, end, tight_m);
        priced_.push_back({static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(end)});
      });
    }
  }
  void price_run(std::size_t first, std::size_t end, float tight_m) {
    const Crowding crowding = crowding_;
    const float* const clearance_m = clearance_m_.data();
    float* const out = metre_cost_.data();
    for (std::size_t i = first; i < end; ++i) {
      const float here_m = clearance_m[i], open = crowding.at(here_m);
      out[i] = here_m < tight_m ? kUnreached : open;
    }
  }

  void open_start_region(const StartRegion& region) {
    leaving_ = {field_->start, field_->start};
    for (int y = field_->start.y - region.reach(); y <= field_->start.y + region.reach(); ++y) {
      for (int x = field_->start.x - region.reach(); x <= field_->start.x + region.reach(); ++x) {
        const CellIndex cell{x, y};
        if (!map_->contains(cell) || map_->is_on_border(cell) || !region.allows(cell)) continue;
        const std::size_t i = map_->index(cell);
        metre_cost_[i] = crowding_.leaving_at(clearance_m_[i]);
        leaving_.extend(cell);
      }
    }
    count_as_priced(leaving_);
  }

  /// Merges the rows of the box into the priced runs.
  void count_as_priced(const CellBox& box) {
    for (int y = box.min.y; y <= box.max.y; ++y) {
      const auto first = static_cast<std::uint32_t>(map_->index({box.min.x, y}));
      priced_.push_back({first, first + static_cast<std::uint32_t>(box.width())});
    }
    std::sort(priced_.begin(), priced_.end(),
              [](const CellRun& a, const CellRun& b) { return a.first < b.first; });
    std::size_t kept = 0;
    for (const CellRun& run : priced_) {
      CellRun& last = priced_[kept == 0 ? 0 : kept - 1];
      if (kept > 0 && run.first <= last.end)
        last.end = std::max(last.end, run.end);
      else
        priced_[kept++] = run;
    }
    priced_.resize(kept);
  }

  /// True when open cells of the start region are connected only across a corner that an occupied cell cuts.
  [[nodiscard]] bool meets_at_corners() const {
    const auto is_open = [&](std::size_t i) { return metre_cost_[i] != kUnreached; };
    for (int y = leaving_.min.y; y <= leaving_.max.y; ++y) {
      for (int x = leaving_.min.x; x <= leaving_.max.x; ++x) {
        const std::size_t i = map_->index({x, y});
        if (!is_open(i)) continue;
        for (unsigned cut = cut_corners(i); cut != 0; cut &= cut - 1) {
          const auto d = static_cast<std::size_t>(std::countr_zero(cut));
          if (is_open(neighbour(i, d)) && !is_open(neighbour(i, d - 1)) &&
              !is_open(neighbour(i, (d + 1) % 8)))
            return true;
        }
      }
    }
    return false;
  }

  /// False when the clearance exceeds one cell: no straight neighbour is occupied then.
  [[nodiscard]] bool is_near_something(float clearance_m) const {
    return clearance_m <= kNearCells * resolution_m_;
  }

  [[nodiscard]] std::size_t neighbour(std::size_t from, std::size_t direction) const {
    return from + static_cast<std::size_t>(offset_[direction]);
  }

  /// Directions, as a bit mask, in which a step would cut the corner of an occupied cell.
  [[nodiscard]] unsigned cut_corners(std::size_t from) const {
    unsigned cut = 0;
    for (std::size_t d = 0; d < kNeighbours.size(); d += 2) {
      if (map_->cells[neighbour(from, d)] == CellState::kOccupied) cut |= 1U << (d + 1) | 1U << ((d + 7) % 8);
    }
    return cut;
  }

  /// Relaxes all eight neighbours at once, three of a row in one vector: a lower cost is rare.
  void expand(BucketQueue::Entry entry) {
    const float* const metre = metre_cost_.data() + entry.index;
    const std::ptrdiff_t width = offset_[2];
    const float here = *metre;
    float* const cost = field_->cost_m.data() + entry.index;
    std::array<Row, kRows.size()> fresh{};
    Flags cheaper{};
    for (std::size_t r = 0; r < kRows.size(); ++r) {
      const std::ptrdiff_t first = kRows[r].dy * width + kRows[r].first_dx;
      fresh[r] = entry.cost_m + half_step_m_[r] * (here + row_at(metre + first));
      cheaper |= (fresh[r] < row_at(cost + first)) & kRows[r].directions;
    }
    auto directions = static_cast<unsigned>(cheaper[0] | cheaper[1] | cheaper[2] | cheaper[3]);
    if (directions == 0) return;
    if (here >= near_cost_ && is_near_something(clearance_m_[entry.index]))
      directions &= ~cut_corners(entry.index);
    for (; directions != 0; directions &= directions - 1) {
      const auto d = static_cast<std::size_t>(std::countr_zero(directions));
      const auto r = static_cast<std::size_t>(kNeighbours[d].y + 1);
      const float cost_m = fresh[r][kNeighbours[d].x - kRows[r].first_dx];
      cost[offset_[d]] = cost_m;
      const auto to = static_cast<std::uint32_t>(static_cast<std::ptrdiff_t>(entry.index) + offset_[d]);
      field_->step[to] = static_cast<std::uint8_t>((d + 4) % 8);
      queue_.push(to, cost_m);
    }
  }

  /// Marks the cells that will be reached. The runs are short and scattered: without prefetching, waiting for
  /// each of them would take longer than a pass over the whole map.
  void mark_later() {
    if (marked_) return;
    marked_ = true;
    runs_.clear(static_cast<std::size_t>(map_->width()));
    for (std::size_t i = 0; i < priced_.size(); ++i) {
      if (i + kAhead < priced_.size()) fetch(metre_cost_, priced_[i + kAhead]);
      add_open(priced_[i]);
    }
    const std::uint32_t here =
        runs_.root_of(runs_.run_of(static_cast<std::uint32_t>(map_->index(field_->start))));
    float* const cost_m = field_->cost_m.data();
    for (std::uint32_t run = here; run < runs_.size(); ++run) {
      if (run + kAhead < runs_.size()) fetch(field_->cost_m, runs_[run + kAhead]);
      if (runs_.root_of(run) != here) continue;
      for (std::size_t i = runs_[run].first; i < runs_[run].end; ++i)
        cost_m[i] = std::min(cost_m[i], TravelField::kLater);
    }
  }

  /// Adds the cells of a run that can be entered.
  void add_open(const CellRun& run) {
    is_open_.resize(run.end - run.first);
    const float* const cost = metre_cost_.data() + run.first;
    std::uint8_t* const is_open = is_open_.data();
    for (std::size_t i = 0; i < is_open_.size(); ++i) is_open[i] = cost[i] < kUnreached ? 1 : 0;
    runs_.add_marked(run.first, is_open_);
  }

  /// Prefetches a run.
  static void fetch(const std::vector<float>& values, const CellRun& run) {
    constexpr std::uint32_t kLine = 64 / sizeof(float);
    for (std::uint32_t i = run.first; i < run.end; i += kLine) __builtin_prefetch(&values[i]);
  }
  /// Runs fetched before they are used, which hides the latency of memory. Changes no result.
  static constexpr std::uint32_t kAhead = 6;

  const DenseMap* map_ = nullptr;
  std::span<const float> clearance_m_;
  Crowding crowding_{TravelRules{}};
  float near_cost_ = 0.0F;  ///< cost of a metre at a clearance of kNearCells
  float resolution_m_ = 0.0F;
  BucketQueue queue_;
  std::vector<float> metre_cost_;  ///< of every cell; infinity where the robot cannot be
  std::vector<CellRun> priced_;    ///< ascending; elsewhere the cost is infinity
  TravelField* field_ = nullptr;
  std::array<std::ptrdiff_t, 8> offset_{};
  std::array<Row, kRows.size()> half_step_m_{};  ///< half the step from a cell to its neighbours
  CellBox leaving_;                    ///< box of the cells opened for a start with too little clearance
  JoinedRuns runs_;                    ///< of the cells that can be entered
  std::vector<std::uint8_t> is_open_;  ///< of one run
  bool complete_ = true, may_pause_ = false, marked_ = false;
};

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

void TravelSearch::advance(double bound_m) { impl_->advance(static_cast<float>(bound_m)); }

double TravelSearch::settled_m() const { return static_cast<double>(impl_->settled_m()); }

std::vector<CellIndex> route_to(const DenseMap& map, const TravelField& field, CellIndex goal) {
  std::vector<CellIndex> route;
  if (!map.contains(goal) || std::isinf(field.cost_m[map.index(goal)])) return route;
  route.push_back(goal);
  for (std::uint8_t step = 0; (step = field.step[map.index(route.back())]) != kNoStep;) {
    types::require(step < kNeighbours.size(), "grid::route_to: a step that is no neighbour");
    const CellIndex here = route.back();
    route.push_back({here.x + kNeighbours[step].x, here.y + kNeighbours[step].y});
  }
  std::reverse(route.begin(), route.end());
  return route;
}

}  // namespace topo::grid
