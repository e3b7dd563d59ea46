// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace topo::grid {

/// Queue of cells in the order of their cost, to within one bucket. No step costs less than the width of a
/// bucket, so the cells of one bucket cannot reduce each other's cost, and each cost is final when its bucket
/// is processed (Dial 1969; Denardo and Fox 1979). No step costs more than the length of the ring.
class BucketQueue {
 public:
  struct Entry {
    std::uint32_t index;
    float cost_m;
  };

  /// Prepares another search; keeps the allocated memory.
  void reset(float step_min_m, float step_max_m) {
    for (auto& bucket : ring_) bucket.clear();
    turn_ = empty_ = 0;
    buckets_per_m_ = 1.0F / step_min_m;
    ring_.resize(std::bit_ceil(static_cast<std::size_t>(std::ceil(step_max_m / step_min_m)) + 2));
  }

  void push(std::uint32_t index, float cost_m) {
    // Conversion to a signed number is one instruction.
    const auto bucket = static_cast<std::size_t>(static_cast<std::int64_t>(cost_m * buckets_per_m_));
    ring_[bucket & (ring_.size() - 1)].push_back({index, cost_m});
  }

  /// Calls f(Entry) until the queue is empty or the next entries cost at least `bound_m`; f may push. True
  /// when the queue was found empty below the bound. Another call continues.
  template <class F>
  bool drain(float bound_m, F&& f) {
    for (; empty_ < ring_.size() && next_m() < bound_m; ++turn_) {
      std::vector<Entry>& bucket = ring_[turn_ & (ring_.size() - 1)];
      empty_ = bucket.empty() ? empty_ + 1 : 0;
      // Rounding may put a new entry into the current bucket, which then grows while it is read.
      for (std::size_t i = 0; i < bucket.size(); ++i) f(Entry(bucket[i]));
      bucket.clear();
    }
    return empty_ >= ring_.size();
  }
  /// All entries that cost less have been passed to f.
  [[nodiscard]] float next_m() const { return static_cast<float>(turn_) / buckets_per_m_; }

 private:
  float buckets_per_m_ = 1.0F;
  std::vector<std::vector<Entry>> ring_;
  std::size_t turn_ = 0;   ///< number of the current bucket
  std::size_t empty_ = 0;  ///< number of empty buckets just before it
};

}  // namespace topo::grid
