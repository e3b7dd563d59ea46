// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/pipeline/scan_pairing.hpp"

#include <algorithm>
#include <utility>

namespace topo::pipeline {

types::Stamp end_of(const types::Scan& scan) {
  return scan.first_beam + types::from_seconds(static_cast<double>(scan.geometry.time_increment_s) *
                                               (scan.beams > 0 ? scan.beams - 1 : 0));
}

void ScanPairing::add(std::span<const types::Odometry> samples) {
  for (const types::Odometry& sample : samples) odometry_.add(sample);
}

void ScanPairing::push(std::deque<types::Scan>& waiting, const types::Scan& scan) {
  if (odometry_.empty()) {
    ++losses_.without_odometry;
    return;
  }
  if (waiting.size() == scans_max_) {
    ++losses_.queue_full;
    waiting.pop_front();
  }
  waiting.push_back(scan);
  newest_ = std::max(newest_, end_of(scan));
}

std::optional<PairedScan> ScanPairing::next(std::deque<types::Scan>& waiting, bool flush) {
  while (!waiting.empty()) {
    const types::Stamp end = end_of(waiting.front());
    const bool ready = flush || odometry_.covers(end) || newest_ - end >= types::from_seconds(wait_s_);
    if (!ready) return std::nullopt;
    const types::Scan scan = waiting.front();
    waiting.pop_front();
    const auto first = odometry_.at(scan.first_beam), last = odometry_.at(end);
    if (first && last) return PairedScan{scan, *first, *last};
  }
  return std::nullopt;
}

}  // namespace topo::pipeline
