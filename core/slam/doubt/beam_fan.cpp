// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/slam/doubt/beam_fan.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace topo::slam {
namespace {

using types::Vector2;

constexpr double kBeside_m = 0.05;  ///< a beam that passes so near goes to the point
constexpr double kShort_m = 0.5;    ///< a wall that stands twice stands no further apart
constexpr float kOwnSurface_m = 0.15F;
constexpr double kBlind_rad = 0.3;  ///< before the first beam no scanner has one: bearings count from there

double bearing(const Vector2& direction, double first_rad) {
  const double angle = std::atan2(direction.y(), direction.x()) - first_rad;
  return angle < 0.0 ? angle + 2.0 * std::numbers::pi : angle;
}

}  // namespace

SurfacePoint surface_at(std::span<const Surfel> surfels, const Point& sensor, const Point& hit) {
  SurfacePoint out{hit.cast<double>(), (sensor - hit).cast<double>().normalized()};
  float nearest2 = kOwnSurface_m * kOwnSurface_m;
  for (const Surfel& surfel : surfels) {
    const float d2 = (surfel.position - hit).squaredNorm();
    if (!surfel.planar || d2 >= nearest2) continue;
    nearest2 = d2;
    out.normal = surfel.normal.cast<double>();
  }
  return out;
}

BeamFan::BeamFan(const Keyframe& keyframe, const types::Se2& T_map_base)
    : laser_(T_map_base * Vector2(keyframe.sensor.cast<double>())) {
  for (const Point& hit : keyframe.content.hits()) {
    const Vector2 end = T_map_base * Vector2(hit.cast<double>());
    const Vector2 beam = end - laser_;
    if (beams_.empty()) first_rad_ = std::atan2(beam.y(), beam.x()) - kBlind_rad;
    beams_.push_back({bearing(beam, first_rad_), end});
    reach_m_ = std::max(reach_m_, beam.norm());
  }
  // In the beams' order already, but for what deskewing and the last bit did.
  std::stable_sort(beams_.begin(), beams_.end(),
                   [](const Beam& a, const Beam& b) { return a.bearing_rad < b.bearing_rad; });
}

bool BeamFan::contradicts(const SurfacePoint& surface, double tolerance_m) const {
  const Vector2 way = surface.position - laser_;
  const double range_m = way.norm();
  if (range_m > reach_m_ + kShort_m || surface.normal.dot(way) >= 0.0) return false;
  const double beside_rad = kBeside_m / std::max(range_m, kBeside_m);
  const double there_rad = bearing(way, first_rad_);
  auto beam = std::lower_bound(beams_.begin(), beams_.end(), there_rad - beside_rad,
                               [](const Beam& b, double bearing_rad) { return b.bearing_rad < bearing_rad; });
  for (; beam != beams_.end() && beam->bearing_rad <= there_rad + beside_rad; ++beam) {
    const Vector2 off = beam->end - surface.position;
    const double beyond_m = off.dot(way) / range_m, before_m = off.dot(surface.normal);
    if (beyond_m > 0.0 && before_m < -tolerance_m) return true;
    if (beyond_m < 0.0 && beyond_m >= -kShort_m && before_m > tolerance_m) return true;
  }
  return false;
}

}  // namespace topo::slam
