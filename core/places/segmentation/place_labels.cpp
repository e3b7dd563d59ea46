// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/segmentation/place_labels.hpp"

#include <algorithm>
#include <cassert>

#include "core/grid/free_runs.hpp"

namespace topo::places {

void PlaceLabels::append(std::uint32_t first, std::uint32_t end, std::uint16_t label) {
  assert(label != 0 && first < end && (runs_.empty() || runs_.back().end <= first));
  if (!runs_.empty() && runs_.back().end == first && runs_.back().label == label)
    runs_.back().end = end;
  else
    runs_.push_back({first, end, label});
  const auto last = static_cast<std::uint32_t>(runs_.size() - 1);
  starts_.resize(std::max<std::size_t>(starts_.size(), ((end - 1) >> kShift) + 1), last);
}

std::uint16_t PlaceLabels::operator[](std::size_t cell) const {
  const std::size_t block = cell >> kShift;
  if (block >= starts_.size()) return 0;
  for (std::size_t r = starts_[block]; r < runs_.size() && runs_[r].first <= cell; ++r)
    if (cell < runs_[r].end) return runs_[r].label;
  return 0;
}

std::vector<std::uint16_t> PlaceLabels::by_cell(std::size_t cells) const {
  std::vector<std::uint16_t> labels(cells, 0);
  for (const Run& run : runs_) std::fill(labels.begin() + run.first, labels.begin() + run.end, run.label);
  return labels;
}

PlaceLabels PlaceLabels::on_free_cells(const grid::DenseMap& map) const {
  PlaceLabels out;
  out.runs_.reserve(runs_.size());
  for (const Run& run : runs_) {
    grid::for_each_free_run(map.cells, run.first, run.end, [&](std::size_t first, std::size_t end) {
      out.append(static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(end), run.label);
    });
  }
  out.runs_.shrink_to_fit();
  return out;
}

}  // namespace topo::places
