// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/skeleton/spurs.hpp"

#include <bit>

#include "core/places/skeleton/fetch_ahead.hpp"
#include "core/types/invariant.hpp"

namespace topo::places {

bool Spurs::drop(Thinning& thinning) {
  std::vector<std::uint32_t> dropped;
  for (std::size_t k = 0; k < thinning.remain.size(); ++k) {
    const std::uint32_t i = thinning.remain[k];
    if (k + kFetchAhead < thinning.remain.size())
      fetch_around(thinning, thinning.remain[k + kFetchAhead], offsets_);
    if (thinning.count_around(i, offsets_) != 1) continue;
    const std::optional<Branch> branch = follow(i, thinning);
    if (!branch) continue;
    const Junction& junction = junction_at(branch->junction, thinning);
    // With no other exit, the branch is all of its component.
    if (junction.exits > 1 && protrusion_m(i, junction, branch->length_m) <= params_.spur_m)
      dropped.insert(dropped.end(), way_.begin(), way_.end());
  }
  for (const std::uint32_t i : at_junctions_)
    thinning.marks[i] &= static_cast<std::uint8_t>(~Thinning::kNode);
  at_junctions_.clear();
  junctions_.clear();
  for (const std::uint32_t i : dropped) thinning.take_away(i, offsets_, [](std::uint32_t) {});
  return !dropped.empty();
}

/// Follows the axis from an end to a junction; nothing when it leads to another end.
std::optional<Spurs::Branch> Spurs::follow(std::uint32_t end, const Thinning& thinning) {
  way_.assign(1, end);
  Branch branch;
  std::uint32_t here = end;
  unsigned ahead = thinning.pattern_at(end, offsets_);
  for (;;) {
    types::require(ahead != 0, "places::Spurs: a branch that ends before a junction");
    const auto direction = static_cast<std::size_t>(std::countr_zero(ahead));
    here = neighbour(here, direction);
    branch.length_m += step_m(map_, direction);
    const unsigned pattern = thinning.pattern_at(here, offsets_);
    const int around = bits_set(pattern);
    if (around == 1) return std::nullopt;
    if (around > 2) break;
    way_.push_back(here);
    ahead = pattern & ~(1U << ((direction + 4) % 8));
  }
  branch.junction = here;
  return branch;
}

const Spurs::Junction& Spurs::junction_at(std::uint32_t cell, Thinning& thinning) {
  if ((thinning.marks[cell] & Thinning::kNode) != 0) return junctions_[junction_of_.at(cell)];
  const auto number = static_cast<std::uint32_t>(junctions_.size());
  const auto take = [&](std::uint32_t i) {
    thinning.marks[i] |= Thinning::kNode;
    junction_of_.set(i, number);
    at_junctions_.push_back(i);
  };
  Junction junction{cell};
  std::size_t next = at_junctions_.size();
  for (take(cell); next < at_junctions_.size(); ++next) {
    const std::uint32_t i = at_junctions_[next];
    const float more_m = clearance_m_[i] - clearance_m_[junction.clearest];
    if (more_m > 0.0F || (more_m == 0.0F && i < junction.clearest)) junction.clearest = i;
    for (unsigned around = thinning.pattern_at(i, offsets_); around != 0; around &= around - 1) {
      const std::uint32_t j = neighbour(i, static_cast<std::size_t>(std::countr_zero(around)));
      if (thinning.count_around(j, offsets_) <= 2)
        ++junction.exits;
      else if ((thinning.marks[j] & Thinning::kNode) == 0)
        take(j);
    }
  }
  return junctions_.emplace_back(junction);
}

/// How far the disc around the end protrudes from the one around the junction. Uses the straight distance,
/// and the length of the branch when that bends.
double Spurs::protrusion_m(std::uint32_t end, const Junction& junction, float length_m) const {
  const double straight_m =
      (map_.centre_of(map_.cell(end)) - map_.centre_of(map_.cell(junction.clearest))).norm();
  const auto along_m = static_cast<double>(length_m);
  const double away_m =
      along_m < params_.straight_ratio * straight_m + params_.straight_cells * map_.resolution_m ? straight_m
                                                                                                 : along_m;
  return away_m + static_cast<double>(clearance_m_[end] - clearance_m_[junction.clearest]);
}

}  // namespace topo::places
