// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/segmentation/ascent.hpp"

#include "core/places/skeleton/erosion.hpp"

namespace topo::places {

Ascent::Ascent(const grid::DenseMap& map, const std::vector<Slope>& slopes,
               std::vector<std::uint32_t>& labels)
    : slopes_(slopes.data()), labels_(labels.data()), offsets_(neighbour_offsets(map)) {}

/// Climbs from a cell to the first labelled one, and gives that label to all cells on the path.
void Ascent::climb_up(std::uint32_t start) {
  std::uint32_t label = 0, i = start;
  std::size_t steps = 0;
  while ((label = labels_[i]) == 0) {
    if (steps == way_.size()) way_.resize(2 * way_.size());
    way_[steps++] = i;
    const Slope up = slopes_[i];
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

/// A neighbour with a final label; the cell itself when there is none.
std::uint32_t Ascent::labelled_beside(std::uint32_t i) const {
  for (std::size_t k = 0; k < 8; ++k) {
    const std::uint32_t j = beside(i, k);
    if (labels_[j] != 0 && labels_[j] != kLost) return j;
  }
  return i;
}

}  // namespace topo::places
