// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/grid/distance.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace topo::grid {
namespace {

// First distances along the columns, then along the rows the lower envelope of parabolas over them (Meijster
// et al. 2000). The first goes over whole rows, cell by cell in vector instructions; the second only over
// runs of cells that are not boundary: no boundary cell sees past another one in its row.

/// Distance along the column, in cells; kNone where the column has no boundary. The maximum of 16 signed bits
/// less one, so that one more fits: SSE2, which every amd64 machine has, knows the minimum of signed ones
/// only. Squares of distances and their sums then fit 32 bits.
using Steps = std::int16_t;
constexpr Steps kNone = 32766;

/// Distance to the next boundary below: one row from the row below it. A mask in place of a branch, so that
/// the compiler makes vector instructions of it.
template <Boundary kBoundary>
void steps_up(const CellState* cells, const Steps* below, Steps* out, std::size_t width) {
  for (std::size_t x = 0; x < width; ++x) {
    const bool open =
        kBoundary == Boundary::kOccupied ? cells[x] != CellState::kOccupied : cells[x] == CellState::kFree;
    const auto mask = static_cast<Steps>(-static_cast<Steps>(open));
    const auto next = static_cast<Steps>(below[x] + 1);
    out[x] = static_cast<Steps>(std::min(next, kNone) & mask);
  }
}

void steps_down(const Steps* above, Steps* row, std::size_t width) {
  for (std::size_t x = 0; x < width; ++x) row[x] = std::min(row[x], static_cast<Steps>(above[x] + 1));
}

/// Lower envelope of the parabolas over one run, whose ends may have a boundary cell just outside.
class RunEnvelope {
 public:
  explicit RunEnvelope(std::size_t width) : sites_(width + 2) {}

  /// Squared distances of the cells [first, end) of a row to out.
  void run(const Steps* row, int first, int end, bool wall_before, bool wall_after, std::int32_t* out) {
    size_ = 0;
    if (wall_before) add(first - 1, 0, first, end);
    for (int x = first; x < end; ++x)
      if (row[x] < kNone) add(x, row[x], first, end);
    if (wall_after) add(end, 0, first, end);
    evaluate(first, end, out);
  }

 private:
  struct Site {
    int x;
    std::int32_t square;  ///< of its distance along the column
    int from;             ///< first cell of the run for which it is the nearest
  };

  static std::int32_t square_at(const Site& site, int x) { return (x - site.x) * (x - site.x) + site.square; }

  /// A site to the right of all before it.
  void add(int x, int steps, int first, int end) {
    Site site{x, steps * steps, first};
    while (size_ > 0) {
      const Site& top = sites_[size_ - 1];
      const std::int32_t farther = square_at(site, top.from) - square_at(top, top.from);
      if (farther >= 0) {
        // With every cell to the right the difference falls by twice the distance of the sites; mostly they
        // are neighbours, and a division costs more than the rest of the loop.
        const int apart = site.x - top.x;
        const std::int32_t cells = (apart == 1 ? farther >> 1 : farther / (2 * apart)) + 1;
        if (cells >= end - top.from) return;
        site.from = top.from + cells;
        break;
      }
      --size_;
    }
    sites_[size_++] = site;
  }

  void evaluate(int first, int end, std::int32_t* out) const {
    if (size_ == 0) {
      std::fill(out + first, out + end, std::numeric_limits<std::int32_t>::max());
      return;
    }
    int stop = end;
    for (std::size_t i = size_; i-- > 0;) {
      for (int x = sites_[i].from; x < stop; ++x) out[x] = square_at(sites_[i], x);
      stop = sites_[i].from;
    }
  }

  std::vector<Site> sites_;
  std::size_t size_ = 0;
};

/// Distances of one row from those along the columns.
class RowPass {
 public:
  RowPass(std::size_t width, double resolution_m, bool open_outside)
      : width_(static_cast<int>(width)),
        resolution_m_(static_cast<float>(resolution_m)),
        open_outside_(open_outside),
        envelope_(width),
        squares_(width) {}

  /// `out` is zero so far. `known` takes runs whose distances are known already: known(first, end) is true
  /// when it has filled them in.
  template <class Known>
  void row(const Steps* steps, float* out, Known&& known) {
    int x = 0;
    while (x < width_) {
      x = skip_boundary(steps, x);
      const int first = x;
      while (x < width_ && steps[x] != 0) ++x;
      if (first == x) break;
      if (known(first, x)) continue;
      const bool wall_before = first > 0 || !open_outside_, wall_after = x < width_ || !open_outside_;
      envelope_.run(steps, first, x, wall_before, wall_after, squares_.data());
      metres(first, x, out);
    }
  }

 private:
  /// From `x` on the first cell that is not boundary, or the end. Most of a map is boundary.
  [[nodiscard]] int skip_boundary(const Steps* steps, int x) const {
    constexpr int kAtOnce = sizeof(std::uint64_t) / sizeof(Steps);
    for (std::uint64_t several = 0; x + kAtOnce <= width_; x += kAtOnce) {
      std::memcpy(&several, steps + x, sizeof several);
      if (several != 0) break;
    }
    while (x < width_ && steps[x] == 0) ++x;
    return x;
  }
  void metres(int first, int end, float* out) const {
    constexpr std::int32_t kFar = std::numeric_limits<std::int32_t>::max();
    const float resolution_m = resolution_m_;  // a copy, which writing to out cannot change
    const std::int32_t* const squares = squares_.data();
    for (int x = first; x < end; ++x) {
      const float distance_m = resolution_m * std::sqrt(static_cast<float>(squares[x]));
      out[x] = squares[x] == kFar ? std::numeric_limits<float>::infinity() : distance_m;
    }
  }

  int width_;
  float resolution_m_;
  bool open_outside_;
  RunEnvelope envelope_;
  std::vector<std::int32_t> squares_;
};

/// Distances along the columns into `steps`: from below first, then from above.
void column_pass(const DenseMap& map, bool open_outside, std::vector<Steps>& steps) {
  const auto width = static_cast<std::size_t>(map.width()), height = static_cast<std::size_t>(map.height());
  const std::vector<Steps> outside(width, open_outside ? kNone : Steps{0});
  const auto up = open_outside ? steps_up<Boundary::kOccupied> : steps_up<Boundary::kOccupiedOrUnknown>;
  steps.resize(map.cells.size());
  for (std::size_t y = 0; y < height; ++y) {
    const Steps* below = y == 0 ? outside.data() : &steps[(y - 1) * width];
    up(&map.cells[y * width], below, &steps[y * width], width);
  }
  for (std::size_t y = height; y-- > 0;) {
    const Steps* above = y + 1 == height ? outside.data() : &steps[(y + 1) * width];
    steps_down(above, &steps[y * width], width);
  }
}

}  // namespace

std::vector<float> clearance_m(const DenseMap& map, Boundary boundary) {
  std::vector<float> clearance(map.cells.size(), 0.0F);
  if (clearance.empty()) return clearance;
  const bool open_outside = boundary == Boundary::kOccupied;
  const auto width = static_cast<std::size_t>(map.width());
  std::vector<Steps> steps;
  column_pass(map, open_outside, steps);
  RowPass pass(width, map.resolution_m, open_outside);
  for (std::size_t at = 0; at < clearance.size(); at += width)
    pass.row(&steps[at], &clearance[at], [](int, int) { return false; });
  return clearance;
}

/// Distances with what they were made of.
struct ClearanceUpdate::Version {
  CellBox box;
  double resolution_m = 0.0;
  std::vector<Steps> steps;
  std::vector<float> clearance_m;
};

struct ClearanceUpdate::Impl {
  Version now, before;
  std::optional<std::vector<std::uint32_t>> changed;
};

namespace {

/// What is still true of the version before. A run of open cells in a row lies between boundary cells; its
/// distances depend on nothing but the distances along the columns within it.
class Kept {
 public:
  template <class Version>
  Kept(const Version& before, const DenseMap& map)
      : box_(before.resolution_m == map.resolution_m ? before.box : CellBox{}),
        steps_(before.steps.data()),
        clearance_m_(before.clearance_m.data()),
        min_x_(map.box.min.x) {}

  /// Row `y` comes; `steps` are its present distances along the columns.
  void begin_row(std::int32_t y, const Steps* steps) {
    now_ = steps;
    inside_ = !box_.empty() && y >= box_.min.y && y <= box_.max.y;
    // Where the row's cell 0 is, or would be, in the array before.
    offset_ =
        inside_ ? (y - box_.min.y) * static_cast<std::ptrdiff_t>(box_.width()) + min_x_ - box_.min.x : 0;
  }

  /// Fills in the whole row when it was as wide and nothing about it has changed.
  bool fill_row(std::size_t width, float* out) const {
    if (!inside_ || box_.min.x != min_x_ || static_cast<std::size_t>(box_.width()) != width ||
        std::memcmp(now_, steps_ + offset_, width * sizeof(Steps)) != 0)
      return false;
    std::memcpy(out, clearance_m_ + offset_, width * sizeof(float));
    return true;
  }

  /// Fills in the run [first, end) when nothing about it has changed.
  bool fill(int first, int end, float* out) const {
    if (!inside_ || min_x_ + first < box_.min.x || min_x_ + end - 1 > box_.max.x) return false;
    if (!was_boundary(first - 1) || !was_boundary(end)) return false;
    const auto count = static_cast<std::size_t>(end - first);
    if (std::memcmp(now_ + first, steps_ + offset_ + first, count * sizeof(Steps)) != 0) return false;
    std::memcpy(out + first, clearance_m_ + offset_ + first, count * sizeof(float));
    return true;
  }

  /// Appends the cells of the row at hand, whose first is cell `at`, that have not the clearance they had.
  void append_changed(std::size_t at, std::size_t width, const float* clearance_m,
                      std::vector<std::uint32_t>& changed) const {
    const auto append = [&](std::size_t x, std::size_t end, auto&& was_m) {
      for (; x < end; ++x)
        if (clearance_m[x] != was_m(x)) changed.push_back(static_cast<std::uint32_t>(at + x));
    };
    const auto none = [](std::size_t) { return 0.0F; };
    if (!inside_) return append(0, width, none);
    const auto first = static_cast<std::size_t>(box_.min.x - min_x_),
               end = first + static_cast<std::size_t>(box_.width());
    const float* const before = clearance_m_ + offset_;
    append(0, first, none);
    constexpr std::size_t kAtOnce = 64;  // mostly nothing has changed
    for (std::size_t x = first; x < end; x += kAtOnce) {
      const std::size_t count = std::min(kAtOnce, end - x);
      if (std::memcmp(clearance_m + x, before + x, count * sizeof(float)) != 0)
        append(x, x + count, [&](std::size_t i) { return before[i]; });
    }
    append(end, width, none);
  }

 private:
  [[nodiscard]] bool was_boundary(int x) const {
    const std::int32_t cell_x = min_x_ + x;
    return cell_x < box_.min.x || cell_x > box_.max.x || steps_[offset_ + x] == 0;
  }

  CellBox box_;
  const Steps* steps_;
  const float* clearance_m_;
  std::int32_t min_x_;
  const Steps* now_ = nullptr;
  bool inside_ = false;
  std::ptrdiff_t offset_ = 0;
};

}  // namespace

ClearanceUpdate::ClearanceUpdate() : impl_(std::make_unique<Impl>()) {}
ClearanceUpdate::~ClearanceUpdate() = default;

const std::vector<float>& ClearanceUpdate::clearance_m() const { return impl_->now.clearance_m; }

const std::optional<std::vector<std::uint32_t>>& ClearanceUpdate::changed() const { return impl_->changed; }

void ClearanceUpdate::take(const DenseMap& map) {
  std::swap(impl_->now, impl_->before);
  Version& now = impl_->now;
  const Version& before = impl_->before;
  const bool is_same = before.resolution_m == map.resolution_m && !before.box.empty() &&
                       map.contains(before.box.min) && map.contains(before.box.max);
  impl_->changed = is_same ? std::optional(std::vector<std::uint32_t>()) : std::nullopt;
  now.box = map.box;
  now.resolution_m = map.resolution_m;
  now.clearance_m.resize(map.cells.size());
  if (now.clearance_m.empty()) return;
  column_pass(map, false, now.steps);
  const auto width = static_cast<std::size_t>(map.width());
  RowPass pass(width, map.resolution_m, false);
  Kept kept(impl_->before, map);
  std::int32_t y = map.box.min.y;
  for (std::size_t at = 0; at < now.clearance_m.size(); at += width, ++y) {
    kept.begin_row(y, &now.steps[at]);
    float* const out = &now.clearance_m[at];
    if (kept.fill_row(width, out)) continue;
    std::fill_n(out, width, 0.0F);
    pass.row(&now.steps[at], out, [&](int first, int end) { return kept.fill(first, end, out); });
    if (is_same) kept.append_changed(at, width, out, *impl_->changed);
  }
}

}  // namespace topo::grid
