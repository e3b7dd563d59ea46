// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/carmen/range_limit.hpp"

#include <algorithm>
#include <cstddef>

#include "core/types/scan.hpp"

namespace topo::daemon {
namespace {

/// A SICK LMS sends 8183 to 8191 units, whatever its unit, where it has no range (telegram listing).
constexpr float kCodes = 8183.0F / 8192.0F;
constexpr float kBelow_m = 1.0F;           ///< the band before the pile that it is held against
constexpr double kShare_min = 1e-3;        ///< of all readings in the pile
constexpr std::size_t kReadings_min = 50;  ///< fewer may be one wall, seen by a robot that stands
constexpr double kSteepness = 20.0;        ///< readings a metre of the pile against those before it

template <class Visit>
void for_each_hit(std::span<const CarmenScan> scans, Visit&& visit) {
  for (const CarmenScan& scan : scans) {
    for (const float range : scan.range_m) {
      if (types::is_hit(range)) visit(range);
    }
  }
}

}  // namespace

std::optional<float> piled_up_range_m(std::span<const CarmenScan> scans) {
  float furthest = 0.0F;
  for_each_hit(scans, [&](float range) { furthest = std::max(furthest, range); });
  const float limit = furthest * kCodes;
  std::size_t all = 0, piled = 0, below = 0;
  for_each_hit(scans, [&](float range) {
    ++all;
    piled += range >= limit ? 1U : 0U;
    below += range < limit && range >= limit - kBelow_m ? 1U : 0U;
  });
  if (piled < kReadings_min || static_cast<double>(piled) < kShare_min * static_cast<double>(all))
    return std::nullopt;
  const double density = static_cast<double>(piled) / static_cast<double>(furthest - limit);
  if (density < kSteepness * static_cast<double>(below) / static_cast<double>(kBelow_m)) return std::nullopt;
  return limit;
}

void mark_no_return(std::span<CarmenScan> scans, float limit_m) {
  for (CarmenScan& scan : scans) {
    scan.range_max_m = std::min(scan.range_max_m, limit_m);
    for (float& range : scan.range_m) {
      if (types::is_hit(range) && range >= limit_m) range = types::kNoReturn;
    }
  }
}

}  // namespace topo::daemon
