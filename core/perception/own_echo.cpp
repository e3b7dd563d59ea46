// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/perception/own_echo.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/perception/footprint_sweep.hpp"
#include "core/types/beam_directions.hpp"

namespace topo::perception {

void OwnEcho::update(const types::Scan& scan, const types::Se2& T_base_laser,
                     const types::Footprint& footprint) {
  if (scan.arrival == newest_) return;
  newest_ = scan.arrival;
  for (Bin& bin : bins_) bin.seen = false;
  types::BeamDirections direction(scan.geometry, T_base_laser.theta_rad);
  const auto ranges = scan.ranges();
  const double outside_m = T_base_laser.translation().norm() + types::reach_m(footprint);
  for (std::size_t i = 0; i < ranges.size(); ++i, direction.advance()) {
    if (!types::is_hit(ranges[i])) continue;
    const auto range_m = static_cast<double>(ranges[i]);
    if (range_m > outside_m) continue;
    if (!contains(footprint, T_base_laser.translation() + range_m * direction.now())) continue;
    const double turn = std::atan2(direction.now().y(), direction.now().x()) / (2.0 * std::numbers::pi) + 0.5;
    Bin& bin = bins_[std::min(static_cast<std::size_t>(std::max(turn, 0.0) * kBins), kBins - 1)];
    if (bin.seen) continue;  // the first beam of a degree stands for it
    bin.seen = true;
    if (bin.since != types::Stamp{} && std::abs(range_m - bin.range_m) <= params_.same_m) continue;
    bin.since = newest_;
    bin.range_m = range_m;
  }
  for (Bin& bin : bins_)
    if (!bin.seen) bin.since = {};
}

bool OwnEcho::lasts(const Bin& bin) const {
  return bin.since != types::Stamp{} && newest_ - bin.since >= params_.lasting;
}

std::optional<types::Sector> OwnEcho::sector() const {
  const auto first = std::find_if(bins_.begin(), bins_.end(), [&](const Bin& b) { return lasts(b); });
  if (first == bins_.end()) return std::nullopt;
  const auto end = std::find_if(first, bins_.end(), [&](const Bin& b) { return !lasts(b); });
  const auto degrees = [&](auto bin) { return static_cast<double>(bin - bins_.begin()) - 180.0; };
  return types::Sector{degrees(first) * types::kDegree_rad, degrees(end) * types::kDegree_rad};
}

}  // namespace topo::perception
