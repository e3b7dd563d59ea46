// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/compass/compass.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "core/compass/extent.hpp"
#include "core/compass/projection.hpp"
#include "core/compass/sampling.hpp"
#include "core/types/geometry.hpp"

namespace topo::compass {
namespace {

constexpr double kQuarterTurn = std::numbers::pi / 2.0;

/// Maximum number of half bins along the radius: a few distant points widen the bins instead. Bounds
/// the memory of a histogram.
constexpr double kHalfBinsMax = 30000.0;

/// Entropy as a function of the angle in radians.
using Curve = std::function<double(double)>;

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Noise of the curve from step to step, which is all that a set of points without a direction has. Second
/// differences exclude the slopes of a building's curve; the median excludes the minimum.
double jitter_of(const std::vector<double>& curve) {
  std::vector<double> bends(curve.size());
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const double before = curve[(i + curve.size() - 1) % curve.size()], after = curve[(i + 1) % curve.size()];
    bends[i] = std::abs(before - 2.0 * curve[i] + after);
  }
  // For normally distributed values: the median is 0.6745 sigma, and sigma of the second difference is
  // sqrt(6).
  return median_of(std::move(bends)) / (0.6745 * std::sqrt(6.0));
}

/// Centre of the minimum around the lowest of the values, in steps. Weights grow with the depth below the
/// ends and fall to 0 at `reach` from the centre, which is why the centre is iterated.
double dip_middle(const std::vector<double>& values, double lowest, double reach) {
  const double edge = std::min(values.front(), values.back());
  double middle = lowest;
  constexpr int kRounds = 8;  // numerical: the centre no longer moves
  for (int round = 0; round < kRounds; ++round) {
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

/// Depth of a place of the curve below the places `aside` steps to both sides. The shape of a building as a
/// whole bends the curve widely, walls in one direction narrowly: of two wings that are skew to each other
/// the lowest value may lie between their dips.
double sharpness(const std::vector<double>& curve, std::size_t at, std::size_t aside) {
  const std::size_t size = curve.size();
  return 0.5 * (curve[(at + size - aside) % size] + curve[(at + aside) % size]) - curve[at];
}

/// Indices of the curve's local minima that are sharper than `least`, the sharpest first, at most `count`;
/// else of its lowest value.
std::vector<std::size_t> sharpest_dips(const std::vector<double>& curve, std::size_t aside, double least,
                                       std::size_t count) {
  std::vector<std::size_t> dips;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const double before = curve[(i + curve.size() - 1) % curve.size()], after = curve[(i + 1) % curve.size()];
    if (curve[i] < before && curve[i] <= after) dips.push_back(i);
  }
  const auto sharper = [&](std::size_t a, std::size_t b) {
    return sharpness(curve, a, aside) > sharpness(curve, b, aside);
  };
  std::stable_sort(dips.begin(), dips.end(), sharper);
  std::erase_if(dips, [&](std::size_t dip) { return !(sharpness(curve, dip, aside) > least); });
  dips.resize(std::min(dips.size(), count));
  if (dips.empty()) dips.push_back(static_cast<std::size_t>(std::ranges::min_element(curve) - curve.begin()));
  return dips;
}

/// Finds the minimum of the entropy of all points, starting from the coarse curve's.
class Refinement {
 public:
  Refinement(const Curve& entropy, const CompassParams& params)
      : entropy_(entropy),
        step_(2.0 * params.fine_step_rad),
        reach_(static_cast<int>(std::ceil(params.coarse_step_rad / step_))),
        aside_rad_(params.aside_rad) {}

  /// Angle of the sharpest minimum of all points, at the minima and half a coarse step beside them: the
  /// ranking by few points may be wrong.
  [[nodiscard]] double sharpest_of(const std::vector<double>& dips_rad) {
    double best = HUGE_VAL, best_rad = 0.0;
    for (const double dip_rad : dips_rad) {
      const double beside = 0.5 * (entropy_(dip_rad - aside_rad_) + entropy_(dip_rad + aside_rad_));
      for (int i = -1; i <= 1; ++i) {
        const double angle_rad = dip_rad + i * step_ * reach_ / 2.0;
        const double depth = entropy_(angle_rad) - beside;
        if (depth < best) best_rad = angle_rad;
        best = std::min(best, depth);
      }
    }
    return best_rad;
  }

  /// Finds the lowest value in steps, then the centre of the minimum around it, which is wide for a building
  /// with wings.
  [[nodiscard]] double refined(double angle_rad) {
    std::vector<double> values;
    for (int i = -2 * reach_; i <= 2 * reach_; ++i) {
      values.push_back(entropy_(angle_rad + i * step_));
    }
    const auto lowest = std::min_element(values.begin() + reach_, values.end() - reach_) - values.begin();
    const double middle = dip_middle(values, static_cast<double>(lowest), 1.5 * reach_);
    return angle_rad + (middle - 2.0 * reach_) * step_;
  }

 private:
  const Curve& entropy_;
  double step_;  ///< the centre of a minimum is found to less than half of this
  int reach_;    ///< a coarse step in units of step_
  double aside_rad_;
};

/// The nearest result angle, in [0, pi/2).
double answer_near(double angle_rad, long answers) {
  const auto all = static_cast<double>(answers);
  const long nearest = std::lround(angle_rad / kQuarterTurn * all) % answers;
  return static_cast<double>(nearest < 0 ? nearest + answers : nearest) * kQuarterTurn / all;
}

/// `few`: curve of the points for the coarse curve; `all`: curve of all points that count.
Compass compass_of(const Curve& few, const Curve& all, const CompassParams& params) {
  Compass compass;
  const auto steps = std::max(4, static_cast<int>(std::lround(kQuarterTurn / params.coarse_step_rad)));
  for (int i = 0; i < steps; ++i) compass.entropy.push_back(few(i * kQuarterTurn / steps));
  const auto lowest = std::min_element(compass.entropy.begin(), compass.entropy.end());
  const double median = median_of(compass.entropy), depth = median - *lowest;
  compass.confidence = median > 0.0 ? depth / median : 0.0;
  const double jitter = jitter_of(compass.entropy);
  if (compass.confidence < params.confidence_min || depth < params.jitters_min * jitter) return compass;

  std::vector<double> dips_rad;
  const auto aside =
      static_cast<std::size_t>(std::max(1L, std::lround(params.aside_rad / kQuarterTurn * steps)));
  for (const std::size_t dip :
       sharpest_dips(compass.entropy, aside, params.jitters_min * jitter, params.dips)) {
    dips_rad.push_back(static_cast<double>(dip) * kQuarterTurn / steps);
  }
  Refinement refinement(all, params);
  compass.angle_rad = answer_near(refinement.refined(refinement.sharpest_of(dips_rad)), params.answers);
  return compass;
}

}  // namespace

Compass entropy_compass(std::span<const types::Vector2> points, const CompassParams& params) {
  if (points.size() < params.points_min) return {};
  const types::Rectangle box = box_of(points);
  const double radius_m = (box.max - box.min).norm() / 2.0 + params.cell_m;
  const double half_bin_m = std::max(params.bin_m / 2.0, radius_m / kHalfBinsMax);
  const Placing placing{(box.min + box.max) / 2.0, half_bin_m, params.cell_m};
  const auto radius = static_cast<float>(radius_m / half_bin_m);
  const std::size_t most = std::min<std::size_t>(params.points_max, UINT16_MAX);
  const Samples samples(points);
  const auto curve_of = [&](std::size_t size) {
    return [radius, cloud = samples.up_to(hash_limit(points.size(), size), placing)](double angle_rad) {
      return Projection(radius, angle_rad, cloud).entropy();
    };
  };
  return compass_of(curve_of(std::min(most, params.coarse_points)), curve_of(most), params);
}

}  // namespace topo::compass
