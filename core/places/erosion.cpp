// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/erosion.hpp"

#include <algorithm>
#include <utility>

#include "core/grid/box_array.hpp"
#include "core/places/fate.hpp"
#include "core/places/first_fates.hpp"
#include "core/places/settling.hpp"
#include "core/places/sparse_scan.hpp"

namespace topo::places {
namespace {

using grid::CellState;
using grid::DenseMap;

/// Changes some cells' clearances under fates that were settled.
class Change {
 public:
  Change(const DenseMap& map, std::span<const float> clearance_m, std::vector<Fate>& fates)
      : map_(map),
        clearance_m_(clearance_m),
        fates_(fates),
        offsets_(neighbour_offsets(map)),
        buckets_per_m_(buckets_per_m(map)) {}

  /// A cell with another clearance; whether its neighbours are on the ridge may have changed as well.
  void apply(std::uint32_t i, Settling& settling) {
    if (map_.is_on_border(map_.cell(i))) return;
    renew(i, settling);
    for (const std::ptrdiff_t offset : offsets_)
      renew(static_cast<std::uint32_t>(static_cast<std::ptrdiff_t>(i) + offset), settling);
  }

 private:
  void renew(std::uint32_t i, Settling& settling) {
    if (map_.cells[i] != CellState::kFree || map_.is_on_border(map_.cell(i))) {
      fates_[i] = 0;
      return;
    }
    if (settling.is_in_doubt(i)) return;  // as a neighbour of another one
    const auto bucket = fate_of(clearance_m_[i], buckets_per_m_);
    const auto kept = static_cast<Fate>(fates_[i] & kFlags & ~Erosion::kRidge);
    fates_[i] = static_cast<Fate>(bucket | kept | (on_ridge(i) ? Erosion::kRidge : 0));
    settling.doubt(i);
  }
  [[nodiscard]] bool on_ridge(std::uint32_t i) const {
    const auto at = [&](std::size_t k) {
      return clearance_m_[static_cast<std::size_t>(static_cast<std::ptrdiff_t>(i) + offsets_[k])];
    };
    const float side = larger(larger(at(0), at(4)), larger(at(2), at(6)));
    const float corner = larger(larger(at(1), at(3)), larger(at(5), at(7)));
    return is_ridge(clearance_m_[i], side, corner, static_cast<float>(map_.resolution_m));
  }

  const DenseMap& map_;
  std::span<const float> clearance_m_;
  std::vector<Fate>& fates_;
  std::array<std::ptrdiff_t, 8> offsets_;
  float buckets_per_m_;
};

/// Fates in the array of a map whose box holds the other's.
std::vector<Fate> carried_over(Erosion before, const DenseMap& map) {
  if (before.box == map.box) return std::move(before.fates);
  return grid::over_box(before.fates, before.box, map.box);
}

/// Cells that are kept, in the order of their turns: within one by number.
std::vector<std::uint32_t> kept_in_order(std::span<const Fate> fates) {
  std::vector<std::uint32_t> cells, ends((kBuckets << 1U) + 1, 0);
  const auto turn = [&](std::uint32_t i) { return static_cast<std::size_t>(fates[i] >> kTurnShift); };
  for_each_with(Erosion::kKept, fates,
                [&](std::size_t i) { cells.push_back(static_cast<std::uint32_t>(i)); });
  for (const std::uint32_t cell : cells) ++ends[turn(cell) + 1];
  for (std::size_t t = 0; t + 1 < ends.size(); ++t) ends[t + 1] += ends[t];
  std::vector<std::uint32_t> kept(cells.size());
  // What was a turn's beginning is its end when it is full.
  for (const std::uint32_t cell : cells) kept[ends[turn(cell)]++] = cell;
  return kept;
}

}  // namespace

std::array<std::ptrdiff_t, 8> neighbour_offsets(const DenseMap& map) {
  const std::ptrdiff_t up = map.width();
  return {1, up + 1, up, up - 1, -1, -up - 1, -up, -up + 1};
}

Erosion erode(const DenseMap& map, std::span<const float> clearance_m) {
  Erosion erosion{map.box, std::vector<Fate>(map.cells.size(), 0), {}};
  if (map.cells.empty()) return erosion;
  Settling settling(map, erosion.fates);
  for (const std::uint32_t i : assume_fates(map, clearance_m, erosion.fates)) settling.doubt(i);
  settling.settle_all();
  erosion.kept = kept_in_order(erosion.fates);
  return erosion;
}

Erosion erode_again(const DenseMap& map, std::span<const float> clearance_m, Erosion before,
                    std::span<const std::uint32_t> changed) {
  Erosion erosion{map.box, carried_over(std::move(before), map), {}};
  if (map.cells.empty()) return erosion;
  Settling settling(map, erosion.fates);
  Change change(map, clearance_m, erosion.fates);
  for (const std::uint32_t i : changed) change.apply(i, settling);
  settling.settle_all();
  erosion.kept = kept_in_order(erosion.fates);
  return erosion;
}

}  // namespace topo::places
