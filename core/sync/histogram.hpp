// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace topo::sync {

/// What a report says of a histogram. Quantiles are upper edges of their bucket: at most 3.2 % above the true
/// value.
struct LatencySummary {
  std::uint64_t count = 0;
  double mean_ns = 0.0;
  std::int64_t p50_ns = 0;
  std::int64_t p99_ns = 0;
  std::int64_t p999_ns = 0;
  std::int64_t max_ns = 0;  ///< exact
};

/// Log-linear histogram of durations: 32 buckets an octave, from 1 ns to 68 s (longer ones count in the last
/// bucket, and show in max). 8 KiB, fixed.
class Histogram {
 public:
  Histogram() = default;
  ~Histogram() = default;
  Histogram(const Histogram&) = delete;
  Histogram& operator=(const Histogram&) = delete;

  /// One writer thread. Wait-free. A negative duration counts as 0.
  void record(std::int64_t duration_ns) noexcept {
    const std::int64_t value = std::max<std::int64_t>(duration_ns, 0);
    increase(buckets_[bucket_of(static_cast<std::uint64_t>(value))], 1U);
    increase(sum_ns_, static_cast<std::uint64_t>(value));
    if (value > max_ns_.load(std::memory_order_relaxed)) max_ns_.store(value, std::memory_order_relaxed);
    increase(count_, 1U);
  }

  /// Any thread. Wait-free. While the writer records, the figures may be one record apart from each other.
  [[nodiscard]] LatencySummary summary() const noexcept {
    LatencySummary s;
    s.count = count();
    s.mean_ns = mean_ns();
    s.p50_ns = quantile_ns(0.5);
    s.p99_ns = quantile_ns(0.99);
    s.p999_ns = quantile_ns(0.999);
    s.max_ns = max_ns();
    return s;
  }

  /// Any thread. The smallest bucket edge that at least the share `q` (0 to 1) of the records does not
  /// exceed; 0 when empty.
  [[nodiscard]] std::int64_t quantile_ns(double q) const noexcept {
    std::uint64_t total = 0;
    for (const auto& b : buckets_) total += b.load(std::memory_order_relaxed);
    if (total == 0) return 0;
    const double rank = std::clamp(q, 0.0, 1.0) * static_cast<double>(total);
    std::uint64_t below = 0;
    for (std::size_t i = 0; i < kBuckets; ++i) {
      below += buckets_[i].load(std::memory_order_relaxed);
      if (below > 0 && static_cast<double>(below) >= rank) {
        return i + 1 == kBuckets ? max_ns() : std::min(upper_edge_ns(i), max_ns());
      }
    }
    return max_ns();
  }

  /// Any thread.
  [[nodiscard]] std::uint64_t count() const noexcept { return count_.load(std::memory_order_relaxed); }
  [[nodiscard]] std::int64_t max_ns() const noexcept { return max_ns_.load(std::memory_order_relaxed); }
  [[nodiscard]] double mean_ns() const noexcept {
    const std::uint64_t n = count();
    return n == 0 ? 0.0
                  : static_cast<double>(sum_ns_.load(std::memory_order_relaxed)) / static_cast<double>(n);
  }

 private:
  static constexpr unsigned kSubBits = 5;   // 32 buckets an octave: 3.1 %
  static constexpr unsigned kOctaves = 31;  // from 2^5 to 2^36 ns; below 2^5 linear
  static constexpr std::size_t kSubBuckets = std::size_t{1} << kSubBits;
  static constexpr std::size_t kBuckets = kSubBuckets * (kOctaves + 1);

  static std::size_t bucket_of(std::uint64_t value) noexcept {
    if (value < kSubBuckets) return static_cast<std::size_t>(value);
    const unsigned octave = static_cast<unsigned>(std::bit_width(value)) - 1U - kSubBits;
    const std::size_t bucket = kSubBuckets * octave + static_cast<std::size_t>(value >> octave);
    return std::min(bucket, kBuckets - 1);
  }

  static std::int64_t upper_edge_ns(std::size_t bucket) noexcept {
    if (bucket < kSubBuckets) return static_cast<std::int64_t>(bucket);
    const unsigned octave = static_cast<unsigned>(bucket / kSubBuckets) - 1U;
    const std::uint64_t mantissa = kSubBuckets + bucket % kSubBuckets;
    return static_cast<std::int64_t>(((mantissa + 1U) << octave) - 1U);
  }

  // One writer: no read-modify-write needed.
  static void increase(std::atomic<std::uint64_t>& a, std::uint64_t by) noexcept {
    a.store(a.load(std::memory_order_relaxed) + by, std::memory_order_relaxed);
  }

  std::array<std::atomic<std::uint64_t>, kBuckets> buckets_{};
  std::atomic<std::uint64_t> count_{0};
  std::atomic<std::uint64_t> sum_ns_{0};
  std::atomic<std::int64_t> max_ns_{0};
};

}  // namespace topo::sync
