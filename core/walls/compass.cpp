// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/walls/compass.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "core/types/geometry.hpp"

namespace topo::walls {
namespace {

constexpr double kQuarterTurn = std::numbers::pi / 2.0;

/// Fewer points than a metre and a half of wall have say nothing of a building.
constexpr std::size_t kPointsMin = 30;

/// Of them the coarse curve is made: its dip is a degree wide and needs no more.
constexpr std::size_t kCoarsePoints = 6000;

/// So many of the coarse curve's minima are looked at with all points.
constexpr std::size_t kDips = 3;

/// The lowest of 90 values of noise is 2.5 sigma below their median.
constexpr double kJitters = 6.0;

/// Bins get wider where a few points far out would ask for more.
constexpr double kHalfBinsMax = 30000.0;

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

/// Points around their middle, in half bins.
struct Cloud {
  std::vector<float> x;
  std::vector<float> y;
};

/// Entropy of the two projections of a cloud. Bins overlap by half: where a wall lies between two bins then
/// does not matter.
class Projections {
 public:
  explicit Projections(float radius) : middle_(std::floor(radius) + 2.5F) {
    const auto bins = static_cast<std::size_t>(2.0F * middle_) + 2;
    along_.resize(bins);
    across_.resize(bins);
  }

  double entropy(const Cloud& cloud, double angle_rad) {
    count(cloud, static_cast<float>(std::cos(angle_rad)), static_cast<float>(std::sin(angle_rad)));
    // Every point is in two bins.
    const double points = 2.0 * static_cast<double>(cloud.x.size());
    return 2.0 * std::log(points) - sum_and_clear() / points;
  }

 private:
  /// Projects a block in vector instructions, then counts it.
  void count(const Cloud& cloud, float c, float s) {
    constexpr std::size_t kBlock = 256;
    std::array<std::int32_t, kBlock> u{}, v{};
    for (std::size_t first = 0; first < cloud.x.size(); first += kBlock) {
      const std::size_t size = std::min(kBlock, cloud.x.size() - first);
      const float* x = &cloud.x[first];
      const float* y = &cloud.y[first];
      for (std::size_t i = 0; i < size; ++i) {
        u[i] = static_cast<std::int32_t>(middle_ + c * x[i] + s * y[i]);
        v[i] = static_cast<std::int32_t>(middle_ + c * y[i] - s * x[i]);
      }
      for (std::size_t i = 0; i < size; ++i) {
        ++along_[static_cast<std::size_t>(u[i])];
        ++across_[static_cast<std::size_t>(v[i])];
      }
    }
  }

  /// Both at once: each sum waits for its own last term only.
  double sum_and_clear() {
    double along = 0.0, across = 0.0;
    std::uint32_t along_before = 0, across_before = 0;
    for (std::size_t i = 0; i < along_.size(); ++i) {
      const std::uint32_t along_here = along_[i], across_here = across_[i];
      along += static_cast<double>(weighted_log_(along_before + along_here));
      across += static_cast<double>(weighted_log_(across_before + across_here));
      along_before = along_here;
      across_before = across_here;
      along_[i] = across_[i] = 0;
    }
    return along + across;
  }

  float middle_;
  WeightedLog weighted_log_;
  std::vector<std::uint32_t> along_;
  std::vector<std::uint32_t> across_;
};

/// Mixes the bits of a point's place in millimetres: which points are left out must not depend on their
/// order.
std::uint64_t hash_of(const types::Vector2& p) {
  const auto mm = [](double v_m) {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(v_m * 1000.0));
  };
  std::uint64_t h = mm(p.x()) * 0x9E3779B97F4A7C15U + mm(p.y()) * 0xC2B2AE3D27D4EB4FU;
  h ^= h >> 32U;
  h *= 0xD6E8FEB86659FD93U;
  return h ^ (h >> 32U);
}

/// How points become a cloud.
struct Placing {
  types::Vector2 middle;  ///< of the points
  double half_bin_m;
  double cell_m;
};

/// As cards are dealt, so that neighbours of one wall, which fall into one bin, are counted far from each
/// other: no count then waits for the one before it.
std::vector<float> dealt(const std::vector<float>& values) {
  constexpr std::size_t kHands = 16;
  std::vector<float> out;
  out.reserve(values.size());
  const std::size_t each = (values.size() + kHands - 1) / kHands;
  for (std::size_t i = 0; i < each; ++i)
    for (std::size_t k = i; k < values.size(); k += each) out.push_back(values[k]);
  return out;
}

/// About `size` of the points, the same ones whatever their order. Each is put somewhere in its cell: rows of
/// cell centres would be a direction of their own, that of the raster.
Cloud thinned(std::span<const types::Vector2> points, std::size_t size, const Placing& placing) {
  const double share = static_cast<double>(size) / static_cast<double>(points.size());
  constexpr double kHashes = 18446744073709551616.0;  // 2 to the power of 64
  const std::uint64_t limit = share >= 1.0 ? UINT64_MAX : static_cast<std::uint64_t>(share * kHashes);
  const double dither = placing.cell_m / 65536.0, corner = placing.cell_m / 2.0;
  Cloud cloud;
  cloud.x.reserve(std::min(points.size(), size + size / 8));
  cloud.y.reserve(cloud.x.capacity());
  for (const types::Vector2& p : points) {
    const std::uint64_t hash = hash_of(p);
    if (hash > limit) continue;
    const double x = p.x() - placing.middle.x() - corner + static_cast<double>(hash & 0xFFFFU) * dither;
    const double y =
        p.y() - placing.middle.y() - corner + static_cast<double>(hash >> 16U & 0xFFFFU) * dither;
    cloud.x.push_back(static_cast<float>(x / placing.half_bin_m));
    cloud.y.push_back(static_cast<float>(y / placing.half_bin_m));
  }
  return {dealt(cloud.x), dealt(cloud.y)};
}

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// How much the curve jumps from step to step: of a set of points without a direction that is all it does.
/// From its second differences, so that the slopes of a building's curve do not count; a median, so that the
/// dip does not.
double jitter_of(const std::vector<double>& curve) {
  std::vector<double> bends(curve.size());
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const double before = curve[(i + curve.size() - 1) % curve.size()], after = curve[(i + 1) % curve.size()];
    bends[i] = std::abs(before - 2.0 * curve[i] + after);
  }
  // For normally distributed values: a median of 0.6745 sigma, and sigma of the second difference is sqrt(6).
  return median_of(std::move(bends)) / (0.6745 * std::sqrt(6.0));
}

/// Middle of the dip around the lowest of the values, in steps: each counts as it lies below the ends, and
/// less with its distance from the middle, up to `reach`; so the middle is looked for again until it stays.
double dip_middle(const std::vector<double>& values, double lowest, double reach) {
  const double edge = std::min(values.front(), values.back());
  double middle = lowest;
  for (int round = 0; round < 8; ++round) {
    double sum = 0.0, moment = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double depth = std::max(0.0, edge - values[i]);
      const double away = (static_cast<double>(i) - middle) / reach;
      const double weight = depth * depth * std::max(0.0, 1.0 - away * away);
      sum += weight;
      moment += weight * static_cast<double>(i);
    }
    if (sum > 0.0) middle = moment / sum;
  }
  return middle;
}

/// Numbers of the curve's local minima, lowest first, at most `count`.
std::vector<std::size_t> lowest_dips(const std::vector<double>& curve, std::size_t count) {
  std::vector<std::size_t> dips;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const double before = curve[(i + curve.size() - 1) % curve.size()], after = curve[(i + 1) % curve.size()];
    if (curve[i] < before && curve[i] <= after) dips.push_back(i);
  }
  const auto lower = [&](std::size_t a, std::size_t b) { return curve[a] < curve[b]; };
  std::stable_sort(dips.begin(), dips.end(), lower);
  dips.resize(std::min(dips.size(), count));
  return dips;
}

/// Finds the minimum of the entropy of all points, starting from the coarse curve's.
class Refinement {
 public:
  Refinement(Projections& projections, const Cloud& cloud, const CompassParams& params)
      : projections_(projections),
        cloud_(cloud),
        step_(2.0 * params.fine_step_rad),
        reach_(static_cast<int>(std::ceil(params.coarse_step_rad / step_))) {}

  /// Of the dips the one that is lowest at half steps: what few points said is not the last word.
  [[nodiscard]] double lowest_of(const std::vector<double>& dips_rad) {
    double best = HUGE_VAL, best_rad = 0.0;
    for (const double dip_rad : dips_rad) {
      for (int i = -1; i <= 1; ++i) {
        const double angle_rad = dip_rad + i * step_ * reach_ / 2.0;
        const double entropy = projections_.entropy(cloud_, angle_rad);
        if (entropy < best) best_rad = angle_rad;
        best = std::min(best, entropy);
      }
    }
    return best_rad;
  }

  /// By steps to the lowest value, then to the middle of the dip around it: a building with wings has a wide
  /// one.
  [[nodiscard]] double refined(double angle_rad) {
    std::vector<double> values;
    for (int i = -2 * reach_; i <= 2 * reach_; ++i) {
      values.push_back(projections_.entropy(cloud_, angle_rad + i * step_));
    }
    const auto lowest = std::min_element(values.begin() + reach_, values.end() - reach_) - values.begin();
    const double middle = dip_middle(values, static_cast<double>(lowest), 1.5 * reach_);
    return angle_rad + (middle - 2.0 * reach_) * step_;
  }

 private:
  Projections& projections_;
  const Cloud& cloud_;
  double step_;  ///< the middle of a dip is known to less than half of it
  int reach_;    ///< a coarse step in these
};

double wrapped(double angle_rad) {
  const double angle = std::fmod(angle_rad, kQuarterTurn);
  const double positive = angle < 0.0 ? angle + kQuarterTurn : angle;
  return positive < kQuarterTurn ? positive : 0.0;
}

}  // namespace

Compass entropy_compass(std::span<const types::Vector2> points, const CompassParams& params) {
  Compass compass;
  if (points.size() < kPointsMin) return compass;
  types::Rectangle box;
  for (const types::Vector2& p : points) box.extend(p);
  const double radius_m = (box.max - box.min).norm() / 2.0 + params.cell_m;
  const double half_bin_m = std::max(params.bin_m / 2.0, radius_m / kHalfBinsMax);
  const Placing placing{(box.min + box.max) / 2.0, half_bin_m, params.cell_m};

  Projections projections(static_cast<float>(radius_m / half_bin_m));
  const Cloud few = thinned(points, std::min(params.points_max, kCoarsePoints), placing);
  const auto steps = std::max(4, static_cast<int>(std::lround(kQuarterTurn / params.coarse_step_rad)));
  for (int i = 0; i < steps; ++i) {
    compass.entropy.push_back(projections.entropy(few, i * kQuarterTurn / steps));
  }
  const auto lowest = std::min_element(compass.entropy.begin(), compass.entropy.end());
  const double median = median_of(compass.entropy), depth = median - *lowest;
  compass.confidence = median > 0.0 ? depth / median : 0.0;
  if (compass.confidence < params.confidence_min || depth < kJitters * jitter_of(compass.entropy))
    return compass;

  std::vector<double> dips_rad;
  for (const std::size_t dip : lowest_dips(compass.entropy, kDips)) {
    dips_rad.push_back(static_cast<double>(dip) * kQuarterTurn / steps);
  }
  const Cloud all = thinned(points, params.points_max, placing);
  Refinement refinement(projections, all, params);
  compass.angle_rad = wrapped(refinement.refined(refinement.lowest_of(dips_rad)));
  return compass;
}

}  // namespace topo::walls
