// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/slam/thinned_log.hpp"

#include <algorithm>
#include <iterator>

namespace topo::bench {

bool Thinner::keeps_next() {
  const std::uint64_t scan = scan_++;
  if (scan == 0) return true;
  if (scan % static_cast<std::uint64_t>(thinning_.every) != 0) return false;
  return std::uniform_real_distribution<double>(0.0, 1.0)(random_) >= thinning_.drop_share;
}

void thin(CarmenLog& log, const Thinning& thinning) {
  Thinner thinner(thinning);
  std::erase_if(log.scans, [&](const CarmenScan&) { return !thinner.keeps_next(); });
}

std::vector<Relation> between_scans(const std::vector<Relation>& relations, const CarmenLog& log) {
  constexpr double kSame_s = 1e-4;  // stamps are written with six digits
  std::vector<double> stamps_s;
  for (const CarmenScan& scan : log.scans) stamps_s.push_back(scan.stamp_s);
  std::sort(stamps_s.begin(), stamps_s.end());
  const auto is_there = [&](double stamp_s) {
    const auto at = std::lower_bound(stamps_s.begin(), stamps_s.end(), stamp_s - kSame_s);
    return at != stamps_s.end() && *at <= stamp_s + kSame_s;
  };
  std::vector<Relation> between;
  std::copy_if(relations.begin(), relations.end(), std::back_inserter(between),
               [&](const Relation& r) { return is_there(r.t1_s) && is_there(r.t2_s); });
  return between;
}

}  // namespace topo::bench
