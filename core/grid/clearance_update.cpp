// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/grid/clearance_update.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include "core/grid/distance_passes.hpp"

namespace topo::grid {
namespace {

/// An array over a box in the place that its rows have in a greater one; zero elsewhere.
template <class T>
std::vector<T> moved(const std::vector<T>& from, const CellBox& box, const CellBox& to) {
  std::vector<T> out(static_cast<std::size_t>(to.width()) * static_cast<std::size_t>(to.height()), T{});
  const std::ptrdiff_t width = static_cast<std::ptrdiff_t>(box.width()),
                       to_width = static_cast<std::ptrdiff_t>(to.width());
  for (std::ptrdiff_t row = 0; row < box.height(); ++row) {
    const std::ptrdiff_t to_row = row + box.min.y - to.min.y;
    std::copy_n(from.begin() + row * width, width, out.begin() + to_row * to_width + box.min.x - to.min.x);
  }
  return out;
}

template <class T>
bool are_same(const T* a, const T* b, std::size_t count) {
  return std::memcmp(a, b, count * sizeof(T)) == 0;
}

}  // namespace

/// The map taken last, and its distances with what they were made of. Outside of it all is unknown, and so it
/// is where the box grows: boundary, at distance 0.
struct ClearanceUpdate::Impl {
  CellBox box;
  double resolution_m = 0.0;
  std::vector<CellState> cells;
  std::vector<Steps> from_above;  ///< distance along the column to the next boundary above
  std::vector<Steps> steps;       ///< to the nearest one
  std::vector<float> clearance_m;
  std::optional<std::vector<std::uint32_t>> changed;

  void lay_out(const DenseMap& map);
  /// Rows whose distances from above are other ones.
  [[nodiscard]] std::vector<bool> renew_from_above(const DenseMap& map);
  void renew_row(std::size_t at, const std::vector<Steps>& now, RowPass& pass, std::vector<float>& row_m);
  void take_over(std::size_t at, int from, int end, const std::vector<float>& row_m);
};

void ClearanceUpdate::Impl::lay_out(const DenseMap& map) {
  const bool is_same =
      resolution_m == map.resolution_m && !box.empty() && map.contains(box.min) && map.contains(box.max);
  changed = is_same ? std::optional(std::vector<std::uint32_t>()) : std::nullopt;
  if (is_same && box == map.box) return;
  const CellBox before = is_same ? box : CellBox{};
  cells = moved(cells, before, map.box);
  from_above = moved(from_above, before, map.box);
  steps = moved(steps, before, map.box);
  clearance_m = moved(clearance_m, before, map.box);
  box = map.box;
  resolution_m = map.resolution_m;
}

std::vector<bool> ClearanceUpdate::Impl::renew_from_above(const DenseMap& map) {
  const auto width = static_cast<std::size_t>(map.width()), height = static_cast<std::size_t>(map.height());
  std::vector<bool> renewed(height, false);
  const std::vector<Steps> outside(width, 0);
  std::vector<Steps> now(width);
  for (std::size_t y = height; y-- > 0;) {
    const std::size_t at = y * width;
    const bool is_other = !are_same(&map.cells[at], &cells[at], width);
    if (!is_other && (y + 1 == height || !renewed[y + 1])) continue;
    std::copy_n(&map.cells[at], width, &cells[at]);
    const Steps* const above = y + 1 == height ? outside.data() : &from_above[at + width];
    steps_on<Boundary::kOccupiedOrUnknown>(&cells[at], above, now.data(), width);
    renewed[y] = !are_same(now.data(), &from_above[at], width);
    if (renewed[y]) std::copy_n(now.data(), width, &from_above[at]);
  }
  return renewed;
}

/// `now`: the distances along the columns of the row that begins at cell `at`. A run of open cells in a row
/// lies between boundary cells; its distances depend on nothing but those along the columns within it.
void ClearanceUpdate::Impl::renew_row(std::size_t at, const std::vector<Steps>& now, RowPass& pass,
                                      std::vector<float>& row_m) {
  constexpr int kAtOnce = 64;  // in most of a row nothing has changed
  const int width = static_cast<int>(now.size());
  const Steps *const is = now.data(), *const was = &steps[at];
  const auto boundary = [&](int x) { return is[x] == 0 && was[x] == 0; };
  for (int x = 0; x < width;) {
    const int block_end = std::min(x + kAtOnce, width);
    if (are_same(is + x, was + x, static_cast<std::size_t>(block_end - x))) {
      x = block_end;
      continue;
    }
    while (is[x] == was[x]) ++x;
    int from = x, end = x + 1;
    while (from > 0 && !boundary(from - 1)) --from;
    while (end < width && !boundary(end)) ++end;
    std::fill(row_m.begin() + from, row_m.begin() + end, 0.0F);
    pass.cells(is, from, end, row_m.data());
    take_over(at, from, end, row_m);
    std::copy(is + from, is + end, &steps[at] + from);
    x = end;
  }
}

void ClearanceUpdate::Impl::take_over(std::size_t at, int from, int end, const std::vector<float>& row_m) {
  for (auto x = static_cast<std::size_t>(from); x < static_cast<std::size_t>(end); ++x) {
    float& was_m = clearance_m[at + x];
    if (row_m[x] == was_m) continue;
    was_m = row_m[x];
    if (changed) changed->push_back(static_cast<std::uint32_t>(at + x));
  }
}

ClearanceUpdate::ClearanceUpdate() : impl_(std::make_unique<Impl>()) {}
ClearanceUpdate::~ClearanceUpdate() = default;

const std::vector<float>& ClearanceUpdate::clearance_m() const { return impl_->clearance_m; }

const std::optional<std::vector<std::uint32_t>>& ClearanceUpdate::changed() const { return impl_->changed; }

void ClearanceUpdate::take(const DenseMap& map) {
  Impl& impl = *impl_;
  impl.lay_out(map);
  if (map.cells.empty()) return;
  const std::vector<bool> renewed = impl.renew_from_above(map);
  const auto width = static_cast<std::size_t>(map.width());
  const std::vector<Steps> outside(width, 0);
  std::vector<Steps> now(width);
  std::vector<float> row_m(width);
  RowPass pass(width, map.resolution_m, false);
  bool below_is_other = false;
  for (std::size_t y = 0; y < renewed.size(); ++y) {
    if (!renewed[y] && !below_is_other) continue;
    const std::size_t at = y * width;
    std::copy_n(&impl.from_above[at], width, now.data());
    steps_back(y == 0 ? outside.data() : &impl.steps[at - width], now.data(), width);
    below_is_other = !are_same(now.data(), &impl.steps[at], width);
    if (below_is_other) impl.renew_row(at, now, pass, row_m);
  }
}

}  // namespace topo::grid
