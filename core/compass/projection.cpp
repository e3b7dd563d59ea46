// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/compass/projection.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace topo::compass {
namespace {

/// n log n of small integers: most bins hold few points, and one logarithm costs as much as ten of these.
class WeightedLog {
 public:
  WeightedLog() {
    for (std::size_t n = 1; n < table_.size(); ++n) table_[n] = of(n);
  }
  [[nodiscard]] float operator()(std::uint32_t n) const { return n < table_.size() ? table_[n] : of(n); }

 private:
  static float of(std::size_t n) {
    const auto x = static_cast<float>(n);
    return x * std::log(x);
  }
  std::array<float, 1024> table_{};
};

const WeightedLog& weighted_log() {
  static const WeightedLog log;
  return log;
}

/// Number of parallel sums: each addition waits only for the last one of its own sum.
constexpr std::size_t kAtOnce = 4;

/// Sum of n log n over pairs of neighbours, with n the points in both. The number of pairs is a multiple of
/// kAtOnce. Exact in any order: 24 bits per term, and less than 2 to the power of 30 in all.
double sum_over_pairs(std::span<const std::uint16_t> half_bins, const WeightedLog& log) {
  std::array<double, kAtOnce> sums{};
  for (std::size_t i = 0; i + 1 < half_bins.size(); i += kAtOnce)
    for (std::size_t k = 0; k < kAtOnce; ++k)
      sums[k] += static_cast<double>(log(std::uint32_t{half_bins[i + k]} + half_bins[i + k + 1]));
  return std::accumulate(sums.begin(), sums.end(), 0.0);
}

}  // namespace

Histogram::Histogram(std::size_t half_bins) : points_((half_bins / kAtOnce + 1) * kAtOnce + 1, 0) {}

void Histogram::add(std::span<const std::int32_t> half_bins) {
  for (const std::int32_t half_bin : half_bins) ++points_[static_cast<std::size_t>(half_bin) + 1];
}

double Histogram::sum() const { return sum_over_pairs(points_, weighted_log()); }

/// Adds one block of points after the other, in vector instructions.
Projection::Projection(float radius, double angle_rad, const Cloud& cloud)
    : points_(cloud.x.size()),
      along_(static_cast<std::size_t>(2.0F * (std::floor(radius) + 2.5F)) + 2),
      across_(along_) {
  constexpr std::size_t kBlock = 256;
  const float c = static_cast<float>(std::cos(angle_rad)), s = static_cast<float>(std::sin(angle_rad));
  const float middle = std::floor(radius) + 2.5F;
  std::array<std::int32_t, kBlock> u{}, v{};
  for (std::size_t first = 0; first < cloud.x.size(); first += kBlock) {
    const std::size_t size = std::min(kBlock, cloud.x.size() - first);
    const float *const x = &cloud.x[first], *const y = &cloud.y[first];
    for (std::size_t i = 0; i < size; ++i) {
      u[i] = static_cast<std::int32_t>(middle + c * x[i] + s * y[i]);
      v[i] = static_cast<std::int32_t>(middle + c * y[i] - s * x[i]);
    }
    along_.add(std::span(u).first(size));
    across_.add(std::span(v).first(size));
  }
}

double Projection::entropy() const {
  // Every point is in two bins.
  const double points = 2.0 * static_cast<double>(points_);
  return 2.0 * std::log(points) - (along_.sum() + across_.sum()) / points;
}

}  // namespace topo::compass
