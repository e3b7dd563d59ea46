// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/walls/projection.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

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

/// Of n log n over `count` pairs of neighbours, a multiple of four, n the points in both. Several sums at
/// once: each waits for its own last term only. Exact whatever the order, as are sums of these: 24 bits a
/// term, and less than 2 to the power of 30 in all.
double sum_over_pairs(const std::uint16_t* half_bins, std::size_t count, const WeightedLog& log) {
  std::array<double, 4> sums{};
  for (std::size_t i = 0; i < count; i += sums.size())
    for (std::size_t k = 0; k < sums.size(); ++k)
      sums[k] += static_cast<double>(log(std::uint32_t{half_bins[i + k]} + half_bins[i + k + 1]));
  return sums[0] + sums[1] + sums[2] + sums[3];
}

}  // namespace

Histogram::Histogram(std::size_t half_bins)
    : sums_(half_bins / kBlock + 1, 0.0), has_changed_(sums_.size(), 0) {
  points_.resize(sums_.size() * kBlock + 1, 0);
}

void Histogram::add(std::span<const std::int32_t> half_bins, std::uint16_t step) {
  if (half_bins.empty()) return;
  std::int32_t least = half_bins.front(), most = least;
  for (const std::int32_t half_bin : half_bins) {
    least = std::min(least, half_bin);
    most = std::max(most, half_bin);
  }
  for (const std::int32_t half_bin : half_bins) {
    std::uint16_t& points = points_[static_cast<std::size_t>(half_bin) + 1];
    points = static_cast<std::uint16_t>(points + step);
  }
  // The last one is in a bin with the next.
  const std::size_t first = static_cast<std::size_t>(least) / kBlock,
                    last = (static_cast<std::size_t>(most) + 1) / kBlock;
  std::fill_n(has_changed_.begin() + static_cast<std::ptrdiff_t>(first), last + 1 - first, std::uint8_t{1});
}

double Histogram::sum() {
  for (std::size_t block = 0; block < sums_.size(); ++block) {
    if (has_changed_[block] == 0) continue;
    sums_[block] = sum_over_pairs(&points_[block * kBlock], kBlock, weighted_log());
    has_changed_[block] = 0;
  }
  return std::accumulate(sums_.begin(), sums_.end(), 0.0);
}

Projection::Projection(float radius, double angle_rad)
    : cos_(static_cast<float>(std::cos(angle_rad))),
      sin_(static_cast<float>(std::sin(angle_rad))),
      middle_(std::floor(radius) + 2.5F),
      along_(static_cast<std::size_t>(2.0F * middle_) + 2),
      across_(along_) {}

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
    along_.add(std::span(u).first(size), step);
    across_.add(std::span(v).first(size), step);
  }
  points_ += by * static_cast<std::int64_t>(cloud.x.size());
}

double Projection::entropy() {
  // Every point is in two bins.
  const double points = 2.0 * static_cast<double>(points_);
  return 2.0 * std::log(points) - (along_.sum() + across_.sum()) / points;
}

}  // namespace topo::walls
