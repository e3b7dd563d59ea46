// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/grid/clearance_update.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <cstring>
#include <span>
#include <utility>

#include "core/grid/box_array.hpp"
#include "core/grid/distance_passes.hpp"
#include "core/grid/other_blocks.hpp"

namespace topo::grid {
namespace {

template <class T>
bool are_same(const T* a, const T* b, std::size_t count) {
  return std::memcmp(a, b, count * sizeof(T)) == 0;
}

/// Columns that are measured together: a row of them fills a cache line.
constexpr std::size_t kStripWidth = 32;

/// Cells [from, end) of a row.
struct Cells {
  int from, end;
};

/// Adds an interval to disjoint intervals and merges those that touch. Intervals arrive almost in ascending
/// order of their begin.
void unite(Cells more, std::vector<Cells>& cells) {
  while (!cells.empty() && more.from <= cells.back().end) {
    more = {std::min(more.from, cells.back().from), std::max(more.end, cells.back().end)};
    cells.pop_back();
  }
  cells.push_back(more);
}

/// Buffers for the renewal of rows, one after the other.
struct RowRenewal {
  RowRenewal(std::size_t width, double resolution_m) : pass(width, resolution_m, false), now_m(width) {}

  RowPass pass;
  std::vector<float> now_m;
  std::vector<Cells> others, reached;
};

/// Distances along adjacent columns, in the rows [low, high).
struct Strip {
  std::size_t first = 0, width = 0;
  std::size_t low = SIZE_MAX, high = 0;
  std::vector<Steps> steps;

  [[nodiscard]] bool has_row(std::size_t y) const { return y >= low && y < high; }
  [[nodiscard]] Steps* row(std::size_t y) { return &steps[(y - low) * width]; }
  [[nodiscard]] const Steps* row(std::size_t y) const { return &steps[(y - low) * width]; }
};

/// The columns of a strip in which a walk through its rows has met a boundary cell.
class MetBoundary {
 public:
  void look(const CellState* cells, std::size_t width) {
    for (std::size_t x = 0; x < width; ++x)
      met_[x] = static_cast<std::uint8_t>(met_[x] | static_cast<std::uint8_t>(cells[x] != CellState::kFree));
  }
  [[nodiscard]] bool in_all(std::size_t width) const { return std::memchr(met_.data(), 0, width) == nullptr; }

 private:
  std::array<std::uint8_t, kStripWidth> met_{};
};

}  // namespace

/// The last map and its distances, with the column distances behind them. Cells outside it, also where the
/// box grows, are unknown: boundary, at distance 0.
struct ClearanceUpdate::Impl {
  CellBox box;
  double resolution_m = 0.0;
  std::vector<CellState> cells;
  std::vector<Steps> steps;  ///< distance along the column to the nearest boundary
  std::vector<float> clearance_m;

  void lay_out(const DenseMap& map);
  [[nodiscard]] std::vector<Strip> renew_cells(const DenseMap& map);
  void widen(Strip& strip) const;
  void measure(Strip& strip) const;
  void renew_row(std::size_t y, std::span<const Strip> strips, RowRenewal& renewal);
  [[nodiscard]] Cells reached_from(Cells there, const float* row_m) const;
};

/// Resizes the arrays to the map.
void ClearanceUpdate::Impl::lay_out(const DenseMap& map) {
  const bool goes_on =
      resolution_m == map.resolution_m && !box.empty() && map.contains(box.min) && map.contains(box.max);
  if (goes_on && box == map.box) return;
  const CellBox before = goes_on ? box : CellBox{};
  cells = over_box(cells, before, map.box);
  steps = over_box(steps, before, map.box);
  clearance_m = over_box(clearance_m, before, map.box);
  box = map.box;
  resolution_m = map.resolution_m;
}

/// Takes the map's cells. Returns the strips that contain changed cells, from the first changed row to the
/// last, not measured yet.
std::vector<Strip> ClearanceUpdate::Impl::renew_cells(const DenseMap& map) {
  const auto width = static_cast<std::size_t>(map.width());
  std::vector<Strip> strips((width - 1) / kStripWidth + 1);
  for_each_other_block(map.cells, cells, width, kStripWidth,
                       [&](std::size_t y, std::size_t x, std::size_t count) {
                         Strip& strip = strips[x / kStripWidth];
                         strip = {x, count, std::min(strip.low, y), y + 1, {}};
                         std::copy_n(&map.cells[y * width + x], count, &cells[y * width + x]);
                       });
  std::erase_if(strips, [](const Strip& strip) { return strip.width == 0; });
  return strips;
}

/// Extends the strip by the rows on both sides in which distances may have changed: until a boundary cell was
/// met in each column. Cells beyond that boundary cell have no nearer one within the strip.
void ClearanceUpdate::Impl::widen(Strip& strip) const {
  const auto width = static_cast<std::size_t>(box.width()), height = static_cast<std::size_t>(box.height());
  for (MetBoundary met; strip.low > 0 && !met.in_all(strip.width);)
    met.look(&cells[--strip.low * width + strip.first], strip.width);
  for (MetBoundary met; strip.high < height && !met.in_all(strip.width);)
    met.look(&cells[strip.high++ * width + strip.first], strip.width);
}

/// Measures from below first, then from above. The old distances beside the strip's ends remain usable: at
/// worst such a distance leads to a boundary cell within the strip, and the measured distance to that cell is
/// smaller.
void ClearanceUpdate::Impl::measure(Strip& strip) const {
  const auto width = static_cast<std::size_t>(box.width()), height = static_cast<std::size_t>(box.height());
  const std::array<Steps, kStripWidth> outside{};
  strip.steps.resize(strip.width * (strip.high - strip.low));
  const Steps* beside = strip.low == 0 ? outside.data() : &steps[(strip.low - 1) * width + strip.first];
  for (std::size_t y = strip.low; y < strip.high; ++y) {
    Steps* const row = strip.row(y);
    steps_on<Boundary::kOccupiedOrUnknown>(&cells[y * width + strip.first], beside, row, strip.width);
    beside = row;
  }
  beside = strip.high == height ? outside.data() : &steps[strip.high * width + strip.first];
  for (std::size_t y = strip.high; y-- > strip.low;) {
    Steps* const row = strip.row(y);
    steps_back(beside, row, strip.width);
    beside = row;
  }
}

/// Stores the measured column distances of the row and updates the row's clearance.
void ClearanceUpdate::Impl::renew_row(std::size_t y, std::span<const Strip> strips, RowRenewal& renewal) {
  const std::size_t at = y * static_cast<std::size_t>(box.width());
  float* const row_m = &clearance_m[at];
  renewal.others.clear();
  for (const Strip& strip : strips) {
    if (!strip.has_row(y)) continue;
    const std::span<const Steps> is(strip.row(y), strip.width);
    Steps* const was = &steps[at + strip.first];
    if (are_same(is.data(), was, is.size())) continue;
    std::size_t from = 0, end = is.size();
    while (is[from] == was[from]) ++from;
    while (is[end - 1] == was[end - 1]) --end;
    std::ranges::copy(is, was);
    unite({static_cast<int>(strip.first + from), static_cast<int>(strip.first + end)}, renewal.others);
  }
  renewal.reached.clear();
  for (const Cells& there : renewal.others) unite(reached_from(there, row_m), renewal.reached);
  float* const now_m = renewal.now_m.data();
  for (const Cells& those : renewal.reached) {
    std::fill(now_m + those.from, now_m + those.end, 0.0F);
    renewal.pass.cells(&steps[at], those.from, those.end, now_m);
    std::copy(now_m + those.from, now_m + those.end, row_m + those.from);
  }
}

/// Cells of a row whose clearance may change when the column distances of the cells `there` change.
Cells ClearanceUpdate::Impl::reached_from(Cells there, const float* row_m) const {
  const auto cell_m = static_cast<float>(resolution_m);
  const int width = static_cast<int>(box.width());
  // A cell whose clearance is at most its distance to `there` neither has nor had its nearest boundary there.
  // Cells beyond it are not affected either, because clearance rises by at most one cell per cell. Half a
  // cell allows for rounding.
  const auto reaches = [&](int x, int away) { return row_m[x] > (static_cast<float>(away) - 0.5F) * cell_m; };
  Cells other = there;
  while (other.from > 0 && reaches(other.from - 1, there.from - other.from + 1)) --other.from;
  while (other.end < width && reaches(other.end, other.end - there.end + 1)) ++other.end;
  return other;
}

ClearanceUpdate::ClearanceUpdate() : impl_(std::make_unique<Impl>()) {}
ClearanceUpdate::~ClearanceUpdate() = default;

const std::vector<float>& ClearanceUpdate::clearance_m() const { return impl_->clearance_m; }

void ClearanceUpdate::take(const DenseMap& map) {
  Impl& impl = *impl_;
  impl.lay_out(map);
  if (map.cells.empty()) return;
  std::vector<Strip> strips = impl.renew_cells(map);
  std::size_t low = SIZE_MAX, high = 0;
  for (Strip& strip : strips) {
    impl.widen(strip);
    impl.measure(strip);
    low = std::min(low, strip.low);
    high = std::max(high, strip.high);
  }
  if (strips.empty()) return;
  RowRenewal renewal(static_cast<std::size_t>(map.width()), map.resolution_m);
  for (std::size_t y = low; y < high; ++y) impl.renew_row(y, strips, renewal);
}

}  // namespace topo::grid
