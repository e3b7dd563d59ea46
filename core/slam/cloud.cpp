// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/cloud.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace topo::slam {
namespace {

/// True when hits i and i + 1 are neighbours on one surface.
bool connected(const Cloud& cloud, std::size_t i, const CloudParams& params) {
  const float gap = (cloud.points[i + 1] - cloud.points[i]).norm();
  const float spacing = std::max(cloud.spacing_m[i], cloud.spacing_m[i + 1]);
  return gap < std::max(static_cast<float>(params.break_factor) * spacing,
                        static_cast<float>(params.break_floor_m));
}

/// First and last index of the run of connected hits around i within the radius; up to neighbours_min
/// connected hits on each side belong to it regardless of their distance.
struct Run {
  std::size_t first, last;
};
Run neighbours(const Cloud& cloud, std::size_t i, const CloudParams& params) {
  const float radius = static_cast<float>(params.normal_radius_m);
  Run run{i, i};
  while (run.first > 0 && connected(cloud, run.first - 1, params)) {
    const float d = (cloud.points[run.first - 1] - cloud.points[i]).norm();
    if (d > radius && i - run.first >= params.neighbours_min) break;
    --run.first;
  }
  while (run.last + 1 < cloud.points.size() && connected(cloud, run.last, params)) {
    const float d = (cloud.points[run.last + 1] - cloud.points[i]).norm();
    if (d > radius && run.last - i >= params.neighbours_min) break;
    ++run.last;
  }
  return run;
}

/// The angle by which noise along the beam turns the fitted line. The noise adds variance * u u^T to the
/// scatter (u: direction of the beam). Where the beam is oblique to the line, this is not across the line and
/// turns the larger eigenvector towards u. The variance is estimated from the scatter across the line.
float noise_tilt(const Point& along, const Point& beam, float small, float large, const CloudParams& params) {
  const Point u = beam.normalized();
  const float u_along = along.dot(u), u_across = -along.y() * u.x() + along.x() * u.y();
  if (std::abs(u_across) < static_cast<float>(params.grazing_sin) || large <= 0.0F) return 0.0F;
  return std::atan(small * u_along / (u_across * large));
}

/// Line fit by the smaller eigenvector of the points' scatter.
Surfel fit(const Cloud& cloud, const Run& run, std::size_t i, const CloudParams& params) {
  const auto count = static_cast<float>(run.last - run.first + 1);
  Point mean = Point::Zero();
  for (std::size_t k = run.first; k <= run.last; ++k) mean += cloud.points[k];
  mean /= count;
  float xx = 0.0F, xy = 0.0F, yy = 0.0F;
  for (std::size_t k = run.first; k <= run.last; ++k) {
    const Point d = cloud.points[k] - mean;
    xx += d.x() * d.x();
    xy += d.x() * d.y();
    yy += d.y() * d.y();
  }
  const float half_trace = 0.5F * (xx + yy);
  const float root = std::sqrt(0.25F * (xx - yy) * (xx - yy) + xy * xy);
  const float small = half_trace - root, large = half_trace + root;
  const Point& p = cloud.points[i];
  const float direction = 0.5F * std::atan2(2.0F * xy, xx - yy);  // of the larger eigenvector
  const float tilt =
      noise_tilt(Point(std::cos(direction), std::sin(direction)), p - cloud.sensor, small, large, params);
  Surfel surfel;
  surfel.normal = Point(-std::sin(direction - tilt), std::cos(direction - tilt));
  if (surfel.normal.dot(cloud.sensor - p) < 0.0F) surfel.normal = -surfel.normal;
  surfel.planar = count >= 3.0F && small < static_cast<float>(params.flat_ratio) * large;
  // The measured point, projected onto the fitted line: averages the noise across the surface and keeps the
  // position along it.
  surfel.position = surfel.planar ? Point(p - surfel.normal.dot(p - mean) * surfel.normal) : p;
  return surfel;
}

/// Selects hits by the distance that the beam has swept at its range, not by the distance of measured points.
/// The latter would prefer points that noise pushes ahead, outwards on one wall of a corridor and inwards on
/// the other, and the map would turn (2 degrees in 60 m at 30 mm of noise).
class Thinning {
 public:
  explicit Thinning(double spacing_m) : spacing_m_(static_cast<float>(spacing_m)), swept_m_(spacing_m_) {}
  bool takes(float spacing_m) {
    swept_m_ += spacing_m;
    if (swept_m_ < spacing_m_) return false;
    swept_m_ = 0.0F;
    return true;
  }

 private:
  float spacing_m_, swept_m_;
};

/// True for the hit of a beam that met an edge and measured a range between the edge and the background: a
/// single reading between two surfaces (veiling points; Tuley, Vandapel and Hebert 2005). A wall at a grazing
/// angle also has jumps from beam to beam, but of nearly equal size.
bool is_mixed(std::span<const float> range_m, std::size_t i, const CloudParams& params) {
  if (i < 2 || i + 2 >= range_m.size()) return false;
  const auto jump_m = static_cast<float>(params.mixed_jump_m), ratio = static_cast<float>(params.mixed_ratio);
  const float before = range_m[i] - range_m[i - 1], after = range_m[i + 1] - range_m[i];
  // False also when a neighbouring beam has no range.
  if (!(before * after > 0.0F) || !(std::abs(before) > jump_m) || !(std::abs(after) > jump_m)) return false;
  return std::abs(range_m[i - 1] - range_m[i - 2]) < ratio * std::abs(before) &&
         std::abs(range_m[i + 2] - range_m[i + 1]) < ratio * std::abs(after);
}

}  // namespace

double invalid_share(const types::Scan& scan) {
  const std::span<const float> ranges_m = scan.ranges();
  const auto invalid = std::count_if(ranges_m.begin(), ranges_m.end(), [](float r) { return std::isnan(r); });
  return ranges_m.empty() ? 0.0 : static_cast<double>(invalid) / static_cast<double>(ranges_m.size());
}

void make_cloud(const types::Scan& scan, const types::Se2& T_base_laser, const SweepMotion& motion,
                const CloudParams& params, Cloud& cloud) {
  cloud.sensor = T_base_laser.translation().cast<float>();
  cloud.points.clear();
  cloud.spacing_m.clear();
  cloud.invalid_share = invalid_share(scan);
  const types::Se2 first = motion.T_ref_first * T_base_laser, last = motion.T_ref_last * T_base_laser;
  const double turn = types::wrap_angle(last.theta_rad - first.theta_rad);
  const double beams = std::max<double>(1.0, scan.beams - 1.0);
  const std::span<const float> ranges_m(scan.range_m.data(), scan.beams);
  const float range_max = std::min(scan.geometry.range_max_m, static_cast<float>(params.range_max_m));
  // One rotation per beam by recurrence instead of a sine and cosine per beam; the drift over 1440 steps is
  // below 1e-12.
  const double step = static_cast<double>(scan.geometry.angle_increment_rad) + turn / beams;
  double c = std::cos(first.theta_rad + static_cast<double>(scan.geometry.angle_min_rad));
  double s = std::sin(first.theta_rad + static_cast<double>(scan.geometry.angle_min_rad));
  const double cs = std::cos(step), ss = std::sin(step);
  const double dx = (last.x_m - first.x_m) / beams, dy = (last.y_m - first.y_m) / beams;
  double x = first.x_m, y = first.y_m;
  for (std::size_t i = 0; i < scan.beams; ++i) {
    const float r = scan.range_m[i];
    if (types::is_hit(r) && r >= scan.geometry.range_min_m && r < range_max &&
        !is_mixed(ranges_m, i, params)) {
      const double range = static_cast<double>(r);
      cloud.points.emplace_back(static_cast<float>(x + range * c), static_cast<float>(y + range * s));
      cloud.spacing_m.push_back(r * std::abs(scan.geometry.angle_increment_rad));
    }
    const double c_next = c * cs - s * ss;
    s = s * cs + c * ss;
    c = c_next;
    x += dx;
    y += dy;
  }
}

void select_points(const Cloud& cloud, const CloudParams& params, std::vector<Point>& out) {
  out.clear();
  Thinning thinning(params.match_spacing_m);
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (thinning.takes(cloud.spacing_m[i])) out.push_back(cloud.points[i]);
  }
  const auto limit = static_cast<std::size_t>(params.match_points_max);
  if (out.size() <= limit) return;
  for (std::size_t i = 0; i < limit; ++i) out[i] = out[i * out.size() / limit];
  out.resize(limit);
}

std::vector<Surfel> make_surfels(const Cloud& cloud, const CloudParams& params) {
  std::vector<Surfel> surfels;
  Thinning thinning(params.match_spacing_m);
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (!thinning.takes(cloud.spacing_m[i])) continue;
    const Run run = neighbours(cloud, i, params);
    // A hit without neighbours is noise or on a wall at a grazing angle: its position on the surface is
    // unknown.
    if (run.last - run.first < 2) continue;
    surfels.push_back(fit(cloud, run, i, params));
  }
  return surfels;
}

}  // namespace topo::slam
