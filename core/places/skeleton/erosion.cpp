// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/skeleton/erosion.hpp"

#include <algorithm>
#include <utility>

#include "core/grid/box_array.hpp"
#include "core/grid/occupancy_grid.hpp"
#include "core/places/skeleton/cells_beside.hpp"
#include "core/places/skeleton/first_states.hpp"
#include "core/places/skeleton/settling.hpp"
#include "core/places/skeleton/sparse_scan.hpp"
#include "core/places/skeleton/thinning_state.hpp"

namespace topo::places {
namespace {

using grid::CellState;
using grid::DenseMap;

/// Changes the clearance of some cells in settled states.
class Change {
 public:
  Change(const DenseMap& map, std::span<const float> clearance_m, std::vector<ThinningState>& states)
      : map_(map),
        clearance_m_(clearance_m),
        fates_(states),
        offsets_(neighbour_offsets(map)),
        buckets_per_m_(buckets_per_m(map)) {}

  /// Renews cells with another clearance, ascending, and their neighbours, which may have joined or left the
  /// ridge.
  void apply(std::span<const std::uint32_t> cells, Settling& settling) {
    for (const grid::CellRun& run : cells_and_beside(map_, cells))
      for (std::uint32_t i = run.first; i < run.end; ++i) renew(i, settling);
  }

 private:
  void renew(std::uint32_t i, Settling& settling) {
    if (map_.cells[i] != CellState::kFree) {
      fates_[i] = 0;
      return;
    }
    const auto bucket = state_of(clearance_m_[i], buckets_per_m_);
    settling.renew(
        i, static_cast<ThinningState>(bucket | (fates_[i] & kOutcome) | (on_ridge(i) ? Erosion::kRidge : 0)));
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
  std::vector<ThinningState>& fates_;
  std::array<std::ptrdiff_t, 8> offsets_;
  float buckets_per_m_;
};

/// Extends the previous erosion to a map whose box contains the earlier one.
Erosion carried_over(Erosion before, const DenseMap& map) {
  if (before.box == map.box) return before;
  Erosion erosion{map.box, grid::over_box(before.states, before.box, map.box), std::move(before.kept)};
  const auto width = static_cast<std::uint32_t>(before.box.width());
  for (std::uint32_t& i : erosion.kept) {
    i = static_cast<std::uint32_t>(map.index({before.box.min.x + static_cast<std::int32_t>(i % width),
                                              before.box.min.y + static_cast<std::int32_t>(i / width)}));
  }
  return erosion;
}

/// Kept cells in the order of their turns, within a turn by number.
std::vector<std::uint32_t> kept_in_order(std::span<const ThinningState> states) {
  std::vector<std::uint32_t> cells, ends((kBuckets << 1U) + 1, 0);
  const auto turn = [&](std::uint32_t i) { return static_cast<std::size_t>(states[i] >> kTurnShift); };
  for_each_with(Erosion::kKept, states,
                [&](std::size_t i) { cells.push_back(static_cast<std::uint32_t>(i)); });
  for (const std::uint32_t cell : cells) ++ends[turn(cell) + 1];
  for (std::size_t t = 0; t + 1 < ends.size(); ++t) ends[t + 1] += ends[t];
  std::vector<std::uint32_t> kept(cells.size());
  // Each entry begins as the start of its turn, and becomes its end.
  for (const std::uint32_t cell : cells) kept[ends[turn(cell)]++] = cell;
  return kept;
}

/// Updates the kept cells after some cells were settled with another turn or outcome; cells may occur
/// repeatedly.
void renew_kept(std::span<const std::uint32_t> settled, Erosion& erosion) {
  auto& states = erosion.states;
  for (const std::uint32_t i : settled) states[i] |= kQueued;  // used as a mark: nothing is queued any more
  std::erase_if(erosion.kept,
                [&](std::uint32_t i) { return (states[i] & (kQueued | Erosion::kKept)) != Erosion::kKept; });
  std::vector<std::uint32_t> come;
  for (const std::uint32_t i : settled) {
    const bool is_marked = (states[i] & kQueued) != 0;
    states[i] &= static_cast<ThinningState>(~kQueued);
    if (is_marked && (states[i] & Erosion::kKept) != 0) come.push_back(i);
  }
  const auto before = [&](std::uint32_t a, std::uint32_t b) {
    const int turn_a = states[a] >> kTurnShift, turn_b = states[b] >> kTurnShift;
    return turn_a != turn_b ? turn_a < turn_b : a < b;
  };
  std::sort(come.begin(), come.end(), before);
  std::vector<std::uint32_t> kept(erosion.kept.size() + come.size());
  std::merge(erosion.kept.begin(), erosion.kept.end(), come.begin(), come.end(), kept.begin(), before);
  erosion.kept = std::move(kept);
}

}  // namespace

std::array<std::ptrdiff_t, 8> neighbour_offsets(const DenseMap& map) {
  const std::ptrdiff_t up = map.width();
  return {1, up + 1, up, up - 1, -1, -up - 1, -up, -up + 1};
}

Erosion erode(const DenseMap& map, std::span<const float> clearance_m) {
  Erosion erosion{map.box, std::vector<ThinningState>(map.cells.size(), 0), {}};
  if (map.cells.empty()) return erosion;
  Settling settling(map, erosion.states);
  for (const std::uint32_t i : assume_states(map, clearance_m, erosion.states)) settling.doubt(i);
  settling.settle_all();
  erosion.kept = kept_in_order(erosion.states);
  return erosion;
}

Erosion erode_again(const DenseMap& map, std::span<const float> clearance_m, Erosion before,
                    std::span<const std::uint32_t> changed) {
  Erosion erosion = carried_over(std::move(before), map);
  if (map.cells.empty()) return erosion;
  Settling settling(map, erosion.states);
  Change(map, clearance_m, erosion.states).apply(changed, settling);
  settling.settle_all();
  renew_kept(settling.others(), erosion);
  return erosion;
}

}  // namespace topo::places
