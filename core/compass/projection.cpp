// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/compass/projection.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numeric>

namespace topo::compass {
namespace {

/// n log n of small integers: most bins hold few points, and one logarithm costs as much as ten of these.
class WeightedLog {
 public:
  WeightedLog() {
    for (std::size_t n = 1; n < table_.size(); ++n) table_[n] = of(n);
    for (std::uint32_t n = 0; n < rises_.size(); ++n) rises_[n] = rise_of(n);
  }
  [[nodiscard]] float operator()(std::uint32_t n) const { return n < table_.size() ? table_[n] : of(n); }
  /// Difference from n to n + 1; exact.
  [[nodiscard]] double rise(std::uint32_t n) const { return n < rises_.size() ? rises_[n] : rise_of(n); }

 private:
  [[nodiscard]] double rise_of(std::uint32_t n) const {
    return static_cast<double>((*this)(n + 1)) - static_cast<double>((*this)(n));
  }
  static float of(std::size_t n) {
    const auto x = static_cast<float>(n);
    return x * std::log(x);
  }
  std::array<float, 1024> table_{};
  std::array<double, 512> rises_{};
};

const WeightedLog& weighted_log() {
  static const WeightedLog log;
  return log;
}

/// Number of parallel sums: each addition waits only for the last one of its own sum.
constexpr std::size_t kAtOnce = 4;

/// Sum of n log n over pairs of neighbours, with n the points in both. The number of pairs is a multiple of
/// kAtOnce. Exact in any order, as are sums of these: 24 bits per term, and less than 2 to the power of 30 in
/// all.
double sum_over_pairs(std::span<const std::uint16_t> half_bins, const WeightedLog& log) {
  std::array<double, kAtOnce> sums{};
  for (std::size_t i = 0; i + 1 < half_bins.size(); i += kAtOnce)
    for (std::size_t k = 0; k < kAtOnce; ++k)
      sums[k] += static_cast<double>(log(std::uint32_t{half_bins[i + k]} + half_bins[i + k + 1]));
  return std::accumulate(sums.begin(), sums.end(), 0.0);
}

}  // namespace

Histogram::Histogram(std::size_t half_bins) : points_((half_bins / kAtOnce + 1) * kAtOnce + 1, 0) {}

void Histogram::add(std::span<const std::int32_t> half_bins, int by) {
  sum_.reset();
  for (const std::int32_t half_bin : half_bins) {
    std::uint16_t& points = points_[static_cast<std::size_t>(half_bin) + 1];
    points = static_cast<std::uint16_t>(points + by);
  }
}

void Histogram::add_few(std::span<const std::int32_t> half_bins, int by) {
  const WeightedLog& log = weighted_log();
  double more = 0.0;
  const double sum = this->sum();
  for (const std::int32_t half_bin : half_bins) {
    std::uint16_t* const beside = &points_[static_cast<std::size_t>(half_bin)];
    assert(by > 0 || beside[1] > 0);
    const std::uint32_t without = beside[1] - (by > 0 ? 0U : 1U);
    more += log.rise(beside[0] + without) + log.rise(beside[2] + without);
    beside[1] = static_cast<std::uint16_t>(beside[1] + by);
  }
  sum_ = sum + by * more;
}

double Histogram::sum() {
  if (!sum_) sum_ = sum_over_pairs(points_, weighted_log());
  return *sum_;
}

Projection::Projection(float radius, double angle_rad)
    : cos_(static_cast<float>(std::cos(angle_rad))),
      sin_(static_cast<float>(std::sin(angle_rad))),
      middle_(std::floor(radius) + 2.5F),
      along_(static_cast<std::size_t>(2.0F * middle_) + 2),
      across_(along_) {}

/// Processes one block of points after the other, in vector instructions.
void Projection::change(const Cloud& cloud, int by) {
  constexpr std::size_t kBlock = 256;
  const bool are_few = cloud.x.size() < along_.few();
  const auto add = [=](Histogram& to, std::span<const std::int32_t> half_bins) {
    are_few ? to.add_few(half_bins, by) : to.add(half_bins, by);
  };
  std::array<std::int32_t, kBlock> u{}, v{};
  for (std::size_t first = 0; first < cloud.x.size(); first += kBlock) {
    const std::size_t size = std::min(kBlock, cloud.x.size() - first);
    const float *const x = &cloud.x[first], *const y = &cloud.y[first];
    const float c = cos_, s = sin_, middle = middle_;
    for (std::size_t i = 0; i < size; ++i) {
      u[i] = static_cast<std::int32_t>(middle + c * x[i] + s * y[i]);
      v[i] = static_cast<std::int32_t>(middle + c * y[i] - s * x[i]);
    }
    add(along_, std::span(u).first(size));
    add(across_, std::span(v).first(size));
  }
  points_ += by * static_cast<std::int64_t>(cloud.x.size());
}

double Projection::entropy() {
  // Every point is in two bins.
  const double points = 2.0 * static_cast<double>(points_);
  return 2.0 * std::log(points) - (along_.sum() + across_.sum()) / points;
}

}  // namespace topo::compass
