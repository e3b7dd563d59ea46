// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/walls/projection.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace topo::walls {
namespace {

/// n log n of small whole numbers: most bins hold few points, and a logarithm costs as much as ten of them.
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

/// Of n log n over pairs of neighbours, n the points in both. Several sums at once: each waits for its own
/// last term only. Exact whatever the order: 24 bits a term, and less than 2 to the power of 30 in all.
double sum_over_bins(const std::vector<std::uint16_t>& half_bins, const WeightedLog& log) {
  std::array<double, 4> sums{};
  std::uint32_t before = half_bins.front();
  const auto term = [&](std::size_t i) {
    const std::uint32_t here = half_bins[i], both = before + here;
    before = here;
    return static_cast<double>(log(both));
  };
  std::size_t i = 1;
  for (; i + sums.size() <= half_bins.size(); i += sums.size())
    for (std::size_t k = 0; k < sums.size(); ++k) sums[k] += term(i + k);
  for (; i < half_bins.size(); ++i) sums[0] += term(i);
  return sums[0] + sums[1] + sums[2] + sums[3];
}

}  // namespace

Projection::Projection(float radius, double angle_rad)
    : cos_(static_cast<float>(std::cos(angle_rad))),
      sin_(static_cast<float>(std::sin(angle_rad))),
      middle_(std::floor(radius) + 2.5F),
      along_(static_cast<std::size_t>(2.0F * middle_) + 2),
      across_(along_.size()) {}

/// A block of points after the other, in vector instructions.
void Projection::change(const Cloud& cloud, int by) {
  constexpr std::size_t kBlock = 256;
  const auto step = static_cast<std::uint16_t>(by);
  std::array<std::int32_t, kBlock> u{}, v{};
  for (std::size_t first = 0; first < cloud.x.size(); first += kBlock) {
    const std::size_t size = std::min(kBlock, cloud.x.size() - first);
    const float *const x = &cloud.x[first], *const y = &cloud.y[first];
    const float c = cos_, s = sin_, middle = middle_;
    for (std::size_t i = 0; i < size; ++i) {
      u[i] = static_cast<std::int32_t>(middle + c * x[i] + s * y[i]);
      v[i] = static_cast<std::int32_t>(middle + c * y[i] - s * x[i]);
    }
    for (std::size_t i = 0; i < size; ++i) {
      std::uint16_t &along = along_[static_cast<std::size_t>(u[i])],
                    &across = across_[static_cast<std::size_t>(v[i])];
      along = static_cast<std::uint16_t>(along + step);
      across = static_cast<std::uint16_t>(across + step);
    }
  }
  points_ += by * static_cast<std::int64_t>(cloud.x.size());
}

double Projection::entropy() const {
  const WeightedLog& log = weighted_log();
  // Every point is in two bins.
  const double points = 2.0 * static_cast<double>(points_);
  return 2.0 * std::log(points) - (sum_over_bins(along_, log) + sum_over_bins(across_, log)) / points;
}

}  // namespace topo::walls
