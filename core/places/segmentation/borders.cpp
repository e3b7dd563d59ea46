// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/segmentation/borders.hpp"

#include <algorithm>

#include "core/places/segmentation/wall_sides.hpp"

namespace topo::places {

Borders::Between& Borders::between(std::uint32_t a, std::uint32_t b) {
  const auto [low, high] = std::minmax(a, b);
  for (std::uint32_t k = newest_[low]; k != kNone; k = all_[k].next)
    if (all_[k].other == high) return all_[k];
  Between& made = all_.emplace_back();
  made.other = high;
  made.next = newest_[low];
  newest_[low] = static_cast<std::uint32_t>(all_.size() - 1);
  ++count_[low];
  ++count_[high];
  return made;
}

void Borders::hand_out(std::vector<Region>& regions, double wall_step_m) const {
  for (std::uint32_t r = 0; r < regions.size(); ++r) {
    regions[r].contacts.clear();
    regions[r].contacts.reserve(count_[r]);
  }
  std::vector<const Between*> of_low;
  for (std::uint32_t low = 0; low < regions.size(); ++low) {
    of_low.clear();
    for (std::uint32_t k = newest_[low]; k != kNone; k = all_[k].next) of_low.push_back(&all_[k]);
    std::sort(of_low.begin(), of_low.end(),
              [](const Between* a, const Between* b) { return a->other < b->other; });
    for (const Between* const b : of_low) {
      Contact contact{b->other,       b->upright, b->level, wall_length_m(b->wall_steps, wall_step_m),
                      b->clearance_m, 0.0F};
      contact.open = static_cast<float>(contact.border());
      regions[low].contacts.push_back(contact);
      contact.other = low;
      regions[b->other].contacts.push_back(contact);
    }
  }
}

}  // namespace topo::places
