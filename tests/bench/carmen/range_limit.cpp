// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/carmen/range_limit.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "core/types/scan.hpp"

namespace topo::bench {
namespace {

/// A SICK LMS sends 8183 to 8191 units, independent of its unit, when it has no range (telegram listing).
constexpr float kCodes = 8183.0F / 8192.0F;
constexpr float kBelow_m = 1.0F;     ///< width of the band below the pile, used for comparison
constexpr double kShare_min = 1e-3;  ///< fraction of all readings that must be in the pile
constexpr std::size_t kReadings_min = 50;
constexpr double kBearings_min = 0.1;   ///< of all beams: fewer may be one wall, seen by a standing robot
constexpr std::size_t kStrays = 10000;  ///< one reading in this many may be beyond the pile
constexpr double kSteepness = 20.0;     ///< minimum ratio of readings per metre in the pile to those below it

template <class Visit>
void for_each_hit(std::span<const CarmenScan> scans, Visit&& visit) {
  for (const CarmenScan& scan : scans) {
    for (std::size_t beam = 0; beam < scan.range_m.size(); ++beam) {
      if (types::is_hit(scan.range_m[beam])) visit(beam, scan.range_m[beam]);
    }
  }
}

/// The longest reading after removal of the strays; 0 when there is none.
float furthest_m(std::span<const CarmenScan> scans) {
  std::vector<float> ranges;
  for_each_hit(scans, [&](std::size_t, float range) { ranges.push_back(range); });
  if (ranges.empty()) return 0.0F;
  const auto last = ranges.end() - 1 - static_cast<std::ptrdiff_t>(ranges.size() / kStrays);
  std::nth_element(ranges.begin(), last, ranges.end());
  return *last;
}

}  // namespace

std::optional<float> piled_up_range_m(std::span<const CarmenScan> scans) {
  const float furthest = furthest_m(scans);
  const float limit = furthest * kCodes;
  std::size_t all = 0, piled = 0, below = 0, beams = 0;
  std::vector<bool> bearings;
  for (const CarmenScan& scan : scans) beams = std::max(beams, scan.range_m.size());
  bearings.resize(beams);
  for_each_hit(scans, [&](std::size_t beam, float range) {
    ++all;
    piled += range >= limit ? 1U : 0U;
    below += range < limit && range >= limit - kBelow_m ? 1U : 0U;
    if (range >= limit) bearings[beam] = true;
  });
  if (piled < kReadings_min || static_cast<double>(piled) < kShare_min * static_cast<double>(all))
    return std::nullopt;
  const auto bearings_piled = std::count(bearings.begin(), bearings.end(), true);
  if (static_cast<double>(bearings_piled) < kBearings_min * static_cast<double>(beams)) return std::nullopt;
  const double density = static_cast<double>(piled) / static_cast<double>(furthest - limit);
  if (density < kSteepness * static_cast<double>(below) / static_cast<double>(kBelow_m)) return std::nullopt;
  return limit;
}

std::size_t mark_no_return(std::span<CarmenScan> scans, float limit_m) {
  std::size_t marked = 0;
  for (CarmenScan& scan : scans) {
    scan.range_max_m = std::min(scan.range_max_m, limit_m);
    for (float& range : scan.range_m) {
      if (!types::is_hit(range) || range < limit_m) continue;
      range = types::kNoReturn;
      ++marked;
    }
  }
  return marked;
}

}  // namespace topo::bench
