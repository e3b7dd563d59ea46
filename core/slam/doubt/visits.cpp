// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/slam/doubt/visits.hpp"

#include <cmath>

namespace topo::slam {
namespace {

constexpr double kStretch_m = 2.5;
constexpr double kGap_m = 15.0;
constexpr double kDetour = 2.0;  ///< way to distance between two visits

}  // namespace

Visits::Visits(std::span<const types::Se2> poses) {
  double way = 0.0;
  std::vector<double> at;
  std::vector<types::Vector2> where;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (i > 0) way += (poses[i].translation() - poses[i - 1].translation()).norm();
    const auto stretch = static_cast<std::size_t>(way / kStretch_m);
    while (at.size() <= stretch) {
      at.push_back(way);
      where.push_back(poses[i].translation());
    }
    stretch_of_.push_back(stretch);
  }
  words_ = (at.size() + 63) / 64;
  others_.assign(at.size() * words_, 0);
  for (std::size_t a = 0; a < at.size(); ++a) {
    for (std::size_t b = 0; b < at.size(); ++b) {
      const double apart = std::abs(at[a] - at[b]);
      if (apart >= kGap_m && apart >= kDetour * (where[a] - where[b]).norm())
        others_[a * words_ + b / 64] |= std::uint64_t{1} << (b % 64);
    }
  }
}

}  // namespace topo::slam
