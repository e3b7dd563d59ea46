// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/compass/compass.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "core/types/geometry.hpp"

namespace topo::compass {
namespace {

constexpr double kQuarterTurn = std::numbers::pi / 2.0;

/// Minimum number of points: those of 1.5 m of wall. Fewer carry no information about a building.
constexpr std::size_t kPointsMin = 30;

/// Points for the coarse curve: its minimum is a degree wide and needs no more.
constexpr std::size_t kCoarsePoints = 6000;

/// Minima of the coarse curve that are evaluated with all points.
constexpr std::size_t kDips = 3;

/// Least depth of a minimum, in multiples of the jitter. The lowest of 90 values of noise is 2.5 sigma below
/// their median.
constexpr double kJitters = 6.0;

/// Maximum number of half bins along the radius: a few distant points widen the bins instead.
constexpr double kHalfBinsMax = 30000.0;

/// Number of result angles over a quarter turn, 0.05 degrees apart: a few more points then leave the angle,
/// and all data in its frame, unchanged.
constexpr long kAnswers = 1800;

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

/// Indices of the curve's local minima, lowest first, at most `count`.
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
  Refinement(const Curve& entropy, const CompassParams& params)
      : entropy_(entropy),
        step_(2.0 * params.fine_step_rad),
        reach_(static_cast<int>(std::ceil(params.coarse_step_rad / step_))) {}

  /// Angle of the lowest entropy of all points, at the minima and half a coarse step beside them: the ranking
  /// by few points may be wrong.
  [[nodiscard]] double lowest_of(const std::vector<double>& dips_rad) {
    double best = HUGE_VAL, best_rad = 0.0;
    for (const double dip_rad : dips_rad) {
      for (int i = -1; i <= 1; ++i) {
        const double angle_rad = dip_rad + i * step_ * reach_ / 2.0;
        const double entropy = entropy_(angle_rad);
        if (entropy < best) best_rad = angle_rad;
        best = std::min(best, entropy);
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
};

/// The nearest result angle, in [0, pi/2).
double answer_near(double angle_rad) {
  const long nearest = std::lround(angle_rad / kQuarterTurn * kAnswers) % kAnswers;
  return static_cast<double>(nearest < 0 ? nearest + kAnswers : nearest) * kQuarterTurn / kAnswers;
}

/// `few`: curve of the points for the coarse curve; `all`: curve of all points that count.
Compass compass_of(const Curve& few, const Curve& all, const CompassParams& params) {
  Compass compass;
  const auto steps = std::max(4, static_cast<int>(std::lround(kQuarterTurn / params.coarse_step_rad)));
  for (int i = 0; i < steps; ++i) compass.entropy.push_back(few(i * kQuarterTurn / steps));
  const auto lowest = std::min_element(compass.entropy.begin(), compass.entropy.end());
  const double median = median_of(compass.entropy), depth = median - *lowest;
  compass.confidence = median > 0.0 ? depth / median : 0.0;
  if (compass.confidence < params.confidence_min || depth < kJitters * jitter_of(compass.entropy))
    return compass;

  std::vector<double> dips_rad;
  for (const std::size_t dip : lowest_dips(compass.entropy, kDips)) {
    dips_rad.push_back(static_cast<double>(dip) * kQuarterTurn / steps);
  }
  Refinement refinement(all, params);
  compass.angle_rad = answer_near(refinement.refined(refinement.lowest_of(dips_rad)));
  return compass;
}

/// Points that are added to a curve and points that are removed from it.
struct Change {
  Cloud come, gone;

  /// The points between two limits of their hashes.
  Change(const Samples& samples, std::uint64_t was, std::uint64_t is, const Placing& placing) {
    if (was == is) return;
    Cloud& cloud = was < is ? come : gone;
    samples.for_each_within(std::min(was, is) + 1, std::max(was, is),
                            [&](const Sample& sample) { sample.append_to(cloud, placing); });
  }
  void apply_to(KeptCurve& curve) const {
    for (auto& [angle_rad, kept] : curve.at) {
      kept.projection.add(come);
      kept.projection.remove(gone);
    }
  }
};

/// Updates the curves to these points.
void renew(CompassMemory& memory, const PointsChange& points, std::uint64_t few_limit,
           std::uint64_t all_limit) {
  const Placing& placing = memory.placing;
  Change few(memory.samples, memory.few.limit, few_limit, placing),
      all(memory.samples, memory.all.limit, all_limit, placing);
  const auto note = [&](const types::Vector2& p, Cloud Change::*where) {
    const Sample sample(p);
    if (sample.hash <= few_limit) sample.append_to(few.*where, placing);
    if (sample.hash <= all_limit) sample.append_to(all.*where, placing);
  };
  for (const types::Vector2& p : points.gone) {
    memory.samples.remove(p);
    note(p, &Change::gone);
  }
  for (const types::Vector2& p : points.come) {
    memory.samples.add(p);
    note(p, &Change::come);
  }
  few.apply_to(memory.few);
  all.apply_to(memory.all);
}

}  // namespace

Compass entropy_compass(const PointsChange& change, const CompassParams& params, CompassMemory& memory) {
  const std::span<const types::Vector2> points = change.now;
  if (points.size() < kPointsMin) {
    memory = {};
    return {};
  }
  const Extent x_m = renewed(memory.x_m, change, [](const types::Vector2&p) { return p.x(); }),
               y_m = renewed(memory.y_m, change, [](const types::Vector2&p) { return p.y(); });
  const types::Rectangle box{{x_m.low, y_m.low}, {x_m.high, y_m.high}};
  const double radius_m = (box.max - box.min).norm() / 2.0 + params.cell_m;
  const double half_bin_m = std::max(params.bin_m / 2.0, radius_m / kHalfBinsMax);
  const Placing placing{(box.min + box.max) / 2.0, half_bin_m, params.cell_m};
  const auto radius = static_cast<float>(radius_m / half_bin_m);
  const std::size_t most = std::min<std::size_t>(params.points_max, UINT16_MAX);
  const std::uint64_t few_limit = hash_limit(points.size(), std::min(most, kCoarsePoints));
  const std::uint64_t all_limit = hash_limit(points.size(), most);
  if (memory.placing != placing || memory.radius != radius)
    memory = {{}, {}, placing, radius, Samples(points), {}, {}};
  else
    renew(memory, change, few_limit, all_limit);
  memory.x_m = x_m;
  memory.y_m = y_m;
  memory.few.limit = few_limit;
  memory.all.limit = all_limit;
  const auto curve = [&](KeptCurve& kept) {
    return [&, cloud = Cloud{}](double angle_rad) mutable {
      const auto [at, is_new] = kept.at.try_emplace(angle_rad, radius, angle_rad);
      if (is_new) {
        if (cloud.x.empty()) cloud = memory.samples.up_to(kept.limit, placing);
        at->second.projection.add(cloud);
      }
      at->second.unused = 0;
      return at->second.projection.entropy();
    };
  };
  for (KeptCurve* const kept : {&memory.few, &memory.all})
    for (auto& [angle_rad, at] : kept->at) ++at.unused;
  Compass compass = compass_of(curve(memory.few), curve(memory.all), params);
  // Angles are kept for a while, because the best minimum may alternate between runs.
  for (KeptCurve* const kept : {&memory.few, &memory.all})
    std::erase_if(kept->at, [](const auto& entry) { return entry.second.unused > 2; });
  return compass;
}

Compass entropy_compass(std::span<const types::Vector2> points, const CompassParams& params) {
  CompassMemory memory;
  return entropy_compass({points, {}, {}}, params, memory);
}

}  // namespace topo::compass
