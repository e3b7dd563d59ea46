// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/ascent.hpp"

#include <algorithm>
#include <array>
#include <cstring>

#include "core/grid/free_runs.hpp"
#include "core/places/erosion.hpp"

namespace topo::places {
namespace {

using grid::CellState;
using grid::DenseMap;

/// Number of the neighbour, as in neighbour_offsets, to which clearance rises most.
using Direction = std::uint8_t;
constexpr Direction kFlat = 8;     ///< it rises nowhere
constexpr Direction kClosed = 16;  ///< the cell is not free

/// Cells side by side that are looked at together, so that the compiler makes vector instructions of them.
constexpr std::size_t kBlock = 64;

/// Of free cells with clearances `at`, in rows of `width`. Not through the corner where two walls meet.
void point_up(const float* at, std::size_t width, std::size_t count, Direction* directions) {
  const float *const low = at - width, *const high = at + width;
  std::array<std::int32_t, kBlock> numbers{};
  for (std::size_t i = 0; i < count; ++i) {
    const float here = at[i];
    const float east = at[i + 1], west = at[i - 1], north = high[i], south = low[i];
    const float level = east >= west ? east : west, upright = north >= south ? north : south;
    const float north_east = high[i + 1], north_west = high[i - 1], south_east = low[i + 1],
                south_west = low[i - 1];
    const float high_corner = east >= west ? north_east : north_west,
                low_corner = east >= west ? south_east : south_west;
    const float diagonal = north >= south ? high_corner : low_corner;
    const float side = (level < upright ? upright : level) - here;
    // The steepest diagonal lies between the two sides to which it rises more.
    const float open = level < upright ? upright : level;
    const float corner = open > 0.0F ? (diagonal - here) * 0.70711F : 0.0F;
    const int to_level = east >= west ? 0 : 4, to_upright = north >= south ? 2 : 6;
    const int high_number = east >= west ? 1 : 3, low_number = east >= west ? 7 : 5;
    const int to_corner = north >= south ? high_number : low_number;
    const int to_side = level >= upright ? to_level : to_upright;
    const int not_corner = side > 0.0F ? to_side : int{kFlat};
    const float other = side > 0.0F ? side : 0.0F;
    numbers[i] = corner > other ? to_corner : not_corner;
  }
  for (std::size_t i = 0; i < count; ++i) directions[i] = static_cast<Direction>(numbers[i]);
}

/// Of all cells between the array's borders.
std::vector<Direction> directions_up(const DenseMap& map, std::span<const float> clearance_m) {
  std::vector<Direction> directions(map.cells.size(), kClosed);
  const auto width = static_cast<std::size_t>(map.width()), height = static_cast<std::size_t>(map.height());
  for (std::size_t y = 1; y + 1 < height; ++y) {
    for (std::size_t x = 1; x + 1 < width; x += kBlock) {
      const std::size_t first = y * width + x, count = std::min(kBlock, width - 1 - x);
      const CellState* const state = &map.cells[first];
      if (std::memchr(state, static_cast<int>(CellState::kFree), count) == nullptr) continue;
      point_up(&clearance_m[first], width, count, &directions[first]);
      for (std::size_t i = 0; i < count; ++i)
        directions[first + i] = state[i] == CellState::kFree ? directions[first + i] : kClosed;
    }
  }
  return directions;
}

class Ascent {
 public:
  Ascent(const DenseMap& map, std::span<const float> clearance_m, std::vector<std::uint32_t>& labels)
      : map_(map),
        directions_(directions_up(map, clearance_m)),
        labels_(labels.data()),
        offsets_(neighbour_offsets(map)) {}

  std::vector<std::uint32_t> run() {
    grid::for_each_free_run(map_, [&](const grid::FreeRun& run) {
      for (std::size_t i = run.first; i < run.end; ++i) {
        if (labels_[i] == 0 && directions_[i] != kClosed) climb(static_cast<std::uint32_t>(i));
      }
    });
    for (const std::uint32_t i : lost_) labels_[i] = 0;
    return std::move(lost_);
  }

 private:
  static constexpr std::uint32_t kLost = UINT32_MAX;

  /// From a cell to the first one with a label, which all cells on the way get.
  void climb(std::uint32_t start) {
    std::uint32_t label = 0, i = start;
    std::size_t steps = 0;
    while ((label = labels_[i]) == 0) {
      if (steps == way_.size()) way_.resize(2 * way_.size());
      way_[steps++] = i;
      const Direction up = directions_[i];
      const std::uint32_t next = up == kFlat ? labelled_beside(i) : beside(i, up);
      if (next == i) {
        label = kLost;
        break;
      }
      i = next;
    }
    for (std::size_t k = 0; k < steps; ++k) labels_[way_[k]] = label;
    if (label == kLost)
      lost_.insert(lost_.end(), way_.begin(), way_.begin() + static_cast<std::ptrdiff_t>(steps));
  }

  /// A neighbour that has its label; else the cell itself.
  [[nodiscard]] std::uint32_t labelled_beside(std::uint32_t i) const {
    for (std::size_t k = 0; k < 8; ++k) {
      const std::uint32_t j = beside(i, k);
      if (labels_[j] != 0 && labels_[j] != kLost) return j;
    }
    return i;
  }
  [[nodiscard]] std::uint32_t beside(std::uint32_t i, std::size_t k) const {
    return static_cast<std::uint32_t>(static_cast<std::ptrdiff_t>(i) + offsets_[k]);
  }

  const DenseMap& map_;
  std::vector<Direction> directions_;
  std::uint32_t* labels_;
  std::array<std::ptrdiff_t, 8> offsets_;
  std::vector<std::uint32_t> way_ = std::vector<std::uint32_t>(64);  ///< longer ones make it longer
  std::vector<std::uint32_t> lost_;
};

}  // namespace

std::vector<std::uint32_t> climb_to_labels(const DenseMap& map, std::span<const float> clearance_m,
                                           std::vector<std::uint32_t>& labels) {
  return Ascent(map, clearance_m, labels).run();
}

}  // namespace topo::places
