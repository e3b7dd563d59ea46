// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/calibration/coronal_fit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "core/slam/surfel_map.hpp"

namespace topo::calibration {
namespace {

constexpr int kIterations = 10;
constexpr double kSlipped_sigmas = 3.0;

/// A return in the scanner's plane, about the scanner: to the robot's left and up, as the mount has it.
struct Return {
  double left_m = 0.0, up_m = 0.0;
  double share = 0.0;  ///< of the sweep before it
};

std::vector<Return> returns_of(const types::Scan& scan, const walls::CoronalMount& mount, double roll_rad,
                               int stride) {
  const double side = mount.mirrored ? -1.0 : 1.0;
  const double last_beam = std::max(1.0, scan.beams - 1.0);
  std::vector<Return> out;
  for (std::size_t i = 0; i < scan.beams; i += static_cast<std::size_t>(stride)) {
    const auto r = static_cast<double>(scan.range_m[i]);
    if (!types::is_hit(scan.range_m[i]) || r > mount.range_max_m) continue;
    const double angle = static_cast<double>(scan.angle_rad(i)) + roll_rad;
    out.push_back({side * r * std::sin(angle), r * std::cos(angle), static_cast<double>(i) / last_beam});
  }
  return out;
}

/// Sums of a weighted least squares with two unknowns.
struct TwoUnknowns {
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
  double square = 0.0;
  std::size_t count = 0;
  void add(const Eigen::Vector2d& slope, double value) {
    information += slope * slope.transpose();
    gradient += slope * value;
    square += value * value;
    ++count;
  }
  [[nodiscard]] Eigen::Vector2d solution() const { return information.ldlt().solve(gradient); }
  /// Variances; the errors of returns of one scan are independent.
  [[nodiscard]] Eigen::Vector2d variance() const {
    const double left = std::max(square - gradient.dot(solution()), 0.0) /
                        std::max<double>(1.0, static_cast<double>(count) - 2.0);
    return left * information.ldlt().solve(Eigen::Matrix2d::Identity()).diagonal();
  }
};

/// The floor as up = height + slope * left, first within a wide gate about the assumed floor, then within
/// ever narrower ones about the line found.
void fit_floor(std::span<const Return> returns, const walls::CoronalMount& before,
               const CoronalParams& params, CoronalFit& out) {
  Eigen::Vector2d line(-before.z_m, 0.0);
  TwoUnknowns sums;
  double left = 0.0, right = 0.0;
  for (int i = 0; i < kIterations; ++i) {
    const double share = 1.0 - static_cast<double>(i) / (kIterations - 1);
    const double gate_m = params.gate_end_m + share * (params.gate_m - params.gate_end_m);
    sums = {};
    left = right = 0.0;
    for (const Return& p : returns) {
      const Eigen::Vector2d slope(1.0, p.left_m);
      if (std::abs(p.up_m - slope.dot(line)) > gate_m + share * params.gate_rad * std::abs(p.left_m))
        continue;
      sums.add(slope, p.up_m);
      left = std::max(left, p.left_m);
      right = std::min(right, p.left_m);
    }
    if (sums.count < static_cast<std::size_t>(params.floor_points_min)) break;
    line = sums.solution();
  }
  out.floor_points = sums.count;
  out.floor_extent_m = left - right;
  out.has_floor = sums.count >= static_cast<std::size_t>(params.floor_points_min) && left > 0.0 &&
                  right < 0.0 && out.floor_extent_m >= params.floor_side_min_m;
  if (!out.has_floor) return;
  const Eigen::Vector2d variance = sums.variance();
  // A scanner rolled towards the left sees the floor rise to its left; mirrored, angles count the other way.
  const double side = before.mirrored ? -1.0 : 1.0;
  out.roll_rad = before.roll_rad + side * std::atan(line[1]);
  out.z_m = -line[0] * std::cos(std::atan(line[1]));
  out.sigma_roll_rad = std::hypot(std::sqrt(variance[1]), params.sigma_floor_rad);
  out.sigma_z_m = std::hypot(std::sqrt(variance[0]), params.sigma_floor_m);
}

double end_s(const types::Scan& scan) {
  return types::to_seconds(scan.first_beam) +
         static_cast<double>(scan.geometry.time_increment_s) * (scan.beams - 1.0);
}

/// What the front scanner saw about a moment, in base_link of that moment.
class FrontView {
 public:
  FrontView(const DriveLog& drive, const WheelTrack& wheels, const RobotNumbers& numbers,
            const slam::MapperParams& params)
      : scans_(drive.front()),
        path_(wheels, numbers.wheels),
        setup_(numbers),
        params_(params),
        map_(params.refine.reach_m) {}

  [[nodiscard]] std::optional<types::Se2> base_at(double stamp_s) const {
    return path_.at(stamp_s + setup_.delay_s);
  }
  /// False when no front scan is within `back_s` of the stamp.
  bool look(double stamp_s, double back_s) {
    while (next_ + 1 < scans_.size() && types::to_seconds(scans_[next_ + 1].first_beam) <= stamp_s) ++next_;
    if (next_ >= scans_.size()) return false;
    const types::Scan& scan = scans_[next_];
    const double first_s = types::to_seconds(scan.first_beam), last_s = end_s(scan);
    const auto here = base_at(stamp_s), first = base_at(first_s), last = base_at(last_s);
    if (std::abs(stamp_s - first_s) > back_s || !here || !first || !last) return false;
    const types::Se2 back = here->inverse();
    slam::make_cloud(scan, setup_.T_base_laser, {back * *first, back * *last}, params_.cloud, cloud_);
    map_.reset(slam::Point::Zero(), params_.cloud.range_max_m);
    map_.add(slam::make_surfels(cloud_, params_.cloud), {});
    return true;
  }
  [[nodiscard]] const slam::Surfel* nearest(const slam::Point& p) const { return map_.nearest(p); }

 private:
  const std::vector<types::Scan>& scans_;
  BasePath path_;
  const RobotNumbers& setup_;
  const slam::MapperParams& params_;
  slam::SurfelMap map_;
  slam::Cloud cloud_;
  std::size_t next_ = 0;
};

/// A return of a wall and the front scanner's surface behind it: normal . (p + place) = offset, place being
/// that of the coronal scanner on the robot.
struct WallPair {
  types::Vector2 p, normal;
  double offset = 0.0;
};

void collect_walls(const types::Scan& scan, FrontView& view, const walls::CoronalMount& mount,
                   double front_z_m, const CoronalParams& params, std::vector<WallPair>& out) {
  const double first_s = types::to_seconds(scan.first_beam), last_s = end_s(scan);
  const double middle_s = 0.5 * (first_s + last_s);
  if (!view.look(middle_s, params.wall_back_s)) return;
  const auto first = view.base_at(first_s), middle = view.base_at(middle_s), last = view.base_at(last_s);
  if (!first || !middle || !last) return;
  const types::Se2 back = middle->inverse();
  const types::Se2 at_first = back * *first, at_last = back * *last;
  const types::Vector2 place(mount.x_m, mount.y_m);
  for (const Return& r : returns_of(scan, mount, mount.roll_rad, 1)) {
    if (std::abs(mount.z_m + r.up_m - front_z_m) > params.wall_height_m) continue;
    // Where the robot was at this beam; that the place turns with it by a milliradian is neglected.
    const types::Vector2 at = types::interpolate(at_first, at_last, r.share) *
                              types::Vector2(place + types::Vector2(0.0, r.left_m));
    const types::Vector2 p = at - place;
    const slam::Surfel* surfel = view.nearest(at.cast<float>());
    if (surfel == nullptr || !surfel->planar) continue;
    const types::Vector2 normal = surfel->normal.cast<double>();
    const double offset = normal.dot(surfel->position.cast<double>());
    if (std::abs(normal.dot(at) - offset) > params.wall_gate_m) continue;
    out.push_back({p, normal, offset});
  }
}

void fit_walls(std::span<const WallPair> pairs, const walls::CoronalMount& mount, const CoronalParams& params,
               CoronalFit& out) {
  Eigen::Vector2d place(mount.x_m, mount.y_m);
  TwoUnknowns sums;
  double sigma_m = params.wall_gate_m;
  for (int i = 0; i < kIterations; ++i) {
    sums = {};
    std::vector<double> left_over;
    for (const WallPair& pair : pairs) {
      const double rest = pair.offset - pair.normal.dot(pair.p);
      const double off = std::abs(rest - pair.normal.dot(place));
      left_over.push_back(off);
      if (off < kSlipped_sigmas * sigma_m) sums.add(pair.normal, rest);
    }
    if (sums.count < static_cast<std::size_t>(params.wall_points_min)) break;
    place = sums.solution();
    const auto middle = left_over.begin() + static_cast<std::ptrdiff_t>(left_over.size() / 2);
    std::nth_element(left_over.begin(), middle, left_over.end());
    sigma_m = std::max(1.4826 * *middle, 0.005);
  }
  out.wall_points = sums.count;
  const Eigen::Vector2d share = sums.information.diagonal() / std::max<double>(1.0, sums.information.trace());
  out.has_walls = sums.count >= static_cast<std::size_t>(params.wall_points_min) &&
                  share.minCoeff() > params.normal_min * params.normal_min;
  if (!out.has_walls) return;
  const Eigen::Vector2d variance = sums.variance();
  out.x_m = place.x();
  out.y_m = place.y();
  out.sigma_x_m = std::hypot(std::sqrt(variance.x()), params.sigma_floor_m);
  out.sigma_y_m = std::hypot(std::sqrt(variance.y()), params.sigma_floor_m);
}

}  // namespace

std::optional<CoronalFit> fit_coronal(const DriveLog& drive, const WheelTrack& wheels,
                                      const RobotNumbers& numbers, const walls::CoronalMount& before,
                                      double front_z_m, const CalibrationParams& params) {
  if (drive.coronal().empty()) return std::nullopt;
  CoronalFit out;
  std::vector<Return> returns;
  for (const types::Scan& scan : drive.coronal()) {
    const auto more = returns_of(scan, before, before.roll_rad, params.coronal.point_stride);
    std::copy_if(more.begin(), more.end(), std::back_inserter(returns),
                 [](const Return& r) { return r.up_m < 0.0; });
  }
  fit_floor(returns, before, params.coronal, out);
  if (!out.has_floor) return out;
  walls::CoronalMount mount = before;
  mount.roll_rad = out.roll_rad;
  mount.z_m = out.z_m;
  FrontView view(drive, wheels, numbers, params.mapper);
  std::vector<WallPair> pairs;
  for (const types::Scan& scan : drive.coronal())
    collect_walls(scan, view, mount, front_z_m, params.coronal, pairs);
  fit_walls(pairs, mount, params.coronal, out);
  return out;
}

}  // namespace topo::calibration
