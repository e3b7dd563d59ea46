// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/perception/stop_zone.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/perception/footprint_sweep.hpp"
#include "core/types/beam_directions.hpp"

namespace topo::perception {
namespace {

using types::Scan;
using types::Twist2;
using types::Vector2;

double bearing_rad(const Scan& scan, const types::Se2& T_base_laser, std::size_t beam) {
  const double sum_rad = static_cast<double>(scan.angle_rad(beam)) + T_base_laser.theta_rad;
  return std::abs(sum_rad) < std::numbers::pi ? sum_rad : types::wrap_angle(sum_rad);
}

bool is_forward(const Scan& scan, const types::Se2& T_base_laser, std::size_t beam, double sector_rad) {
  return std::abs(bearing_rad(scan, T_base_laser, beam)) <= sector_rad;
}

/// Beams that lie within the forward sector at least, when the scan covers it; infinity where the increment
/// is not a step to another direction.
double beams_of_sector(const types::ScanGeometry& geometry, double sector_rad) {
  const double step_rad = std::abs(static_cast<double>(geometry.angle_increment_rad));
  if (!(step_rad > 0.0) || std::isinf(step_rad)) return HUGE_VAL;
  // Where the sector is a multiple of the increment, rounding may place the beams at both ends outside.
  constexpr double kRounding = 1e-3;
  return std::floor(2.0 * sector_rad / step_rad - kRounding);
}

bool is_valid_range(float range_m) { return types::is_hit(range_m) || range_m == types::kNoReturn; }

/// One past the last invalid beam from `beam` on.
std::size_t gap_end(const Scan& scan, std::size_t beam) {
  while (beam < scan.beams && std::isnan(scan.range_m[beam])) ++beam;
  return beam;
}

/// Invalid beams in the gap [begin, end) that no mask explains.
std::size_t unmasked(const Scan& scan, const types::Se2& T_base_laser, std::size_t begin, std::size_t end,
                     const types::Sectors& masks) {
  if (masks.count == 0) return end - begin;
  std::size_t count = 0;
  for (std::size_t i = begin; i < end; ++i)
    if (!masks.holds(bearing_rad(scan, T_base_laser, i))) ++count;
  return count;
}

/// Range assumed for an invalid beam in the gap [begin, end).
float gap_range_m(const Scan& scan, const types::Se2& T_base_laser, std::size_t begin, std::size_t end,
                  const StopZoneParams& params) {
  const float least_m = std::max(scan.geometry.range_min_m, params.least_range_m);
  if (unmasked(scan, T_base_laser, begin, end, params.masks) > params.bridged_beams || begin == 0 ||
      end == scan.beams)
    return least_m;
  const float nearer_m = std::min(scan.range_m[begin - 1], scan.range_m[end]);
  return nearer_m < least_m ? least_m : nearer_m;
}

/// Nearest beam to one side that measured a distance, at most `away_max` away; `beam` itself when there is
/// none.
std::size_t neighbour(const Scan& scan, std::size_t beam, bool after, std::size_t away_max) {
  for (std::size_t away = 1; away <= away_max; ++away) {
    if (after ? beam + away >= scan.beams : away > beam) return beam;
    const std::size_t other = after ? beam + away : beam - away;
    if (types::is_hit(scan.range_m[other])) return other;
    if (scan.range_m[other] == types::kNoReturn) return beam;
  }
  return beam;
}

/// Squared distance between the hits of two beams a few steps apart.
double gap_square_m2(const Scan& scan, std::size_t a, std::size_t b) {
  const double ra = static_cast<double>(scan.range_m[a]), rb = static_cast<double>(scan.range_m[b]);
  const double angle_rad = static_cast<double>(scan.geometry.angle_increment_rad) *
                           (static_cast<double>(a) - static_cast<double>(b));
  return (ra - rb) * (ra - rb) + ra * rb * angle_rad * angle_rad;
}

bool is_mixed_pixel(const Scan& scan, std::size_t beam, const MixedPixelParams& params) {
  if (scan.range_m[beam] < params.from_m) return false;
  const auto apart = [&](bool after) {
    const std::size_t other = neighbour(scan, beam, after, params.beams_max);
    return other != beam && gap_square_m2(scan, beam, other) > params.gap_m * params.gap_m;
  };
  return apart(false) && apart(true);
}

/// Calls visit(point in base, in forward sector) for every obstacle point of the scan.
template <class Visit>
void for_each_obstacle(const Scan& scan, const types::Se2& T_base_laser, const StopZoneParams& params,
                       Visit visit) {
  const float least_m = std::max(scan.geometry.range_min_m, params.least_range_m);
  types::BeamDirections direction(scan.geometry, T_base_laser.theta_rad);
  const auto point = [&](float range_m) -> Vector2 {
    return T_base_laser.translation() + static_cast<double>(range_m) * direction.now();
  };
  std::size_t gap_begin = 0, gap_until = 0;
  float taken_m = 0.0F;  // of the gap that ends at gap_until
  for (std::size_t i = 0; i < scan.beams; ++i, direction.advance()) {
    const float range_m = scan.range_m[i];
    if (range_m == types::kNoReturn) continue;
    const bool forward = is_forward(scan, T_base_laser, i, params.forward_sector_rad);
    if (types::is_hit(range_m)) {
      if (!is_mixed_pixel(scan, i, params.mixed_pixel)) visit(point(range_m), forward);
      continue;
    }
    if (!forward) continue;
    if (range_m == types::kTooNear) {
      visit(point(least_m), true);
      continue;
    }
    if (i >= gap_until) {
      gap_begin = i;
      while (gap_begin > 0 && std::isnan(scan.range_m[gap_begin - 1])) --gap_begin;
      gap_until = gap_end(scan, i);
      taken_m = gap_range_m(scan, T_base_laser, gap_begin, gap_until, params);
    }
    if (taken_m != types::kNoReturn) visit(point(taken_m), true);
  }
}

/// True for a point in the front half of the outline while the robot backs off from a touch.
bool is_left_behind(const Vector2& p, const types::RobotLimits& limits, const Surroundings& around) {
  return around.backing_off && p.x() > 0.0 && contains(limits.footprint, p);
}

/// Calls visit(point) for the obstacles of the scan that are not the robot itself.
template <class Visit>
void for_each_scan_point(const types::RobotLimits& limits, const Surroundings& around, Visit visit) {
  if (around.front_scan == nullptr) return;
  const auto look = [&](const Vector2& p, bool forward) {
    // Outside the forward sector, a hit within the outline is the robot itself.
    if (!forward && contains(limits.footprint, p)) return;
    if (!is_left_behind(p, limits, around)) visit(p);
  };
  if (around.points.empty())
    return for_each_obstacle(*around.front_scan, around.T_base_laser, around.params, look);
  for (const ScanPoint& point : around.points) look(point.p_base, point.forward);
}

bool is_fresh_echo(const types::SonarReading& reading, const Surroundings& around) {
  const types::Duration age = around.now - reading.stamp;
  return reading.stamp != types::Stamp{} && age >= types::Duration::zero() &&
         age <= around.params.sonar_age_max && std::isfinite(reading.range_m) &&
         static_cast<double>(reading.range_m) < around.sonar_range_max_m;
}

template <class Visit>
void for_each_echo(const types::RobotLimits& limits, const Surroundings& around, Visit visit) {
  for (std::size_t i = 0; i < std::min(around.sonar.size(), around.T_base_sonar.size()); ++i) {
    if (!is_fresh_echo(around.sonar[i], around)) continue;
    const Vector2 p = around.T_base_sonar[i] * Vector2{static_cast<double>(around.sonar[i].range_m), 0.0};
    if (!is_left_behind(p, limits, around)) visit(p);
  }
}

/// Margin that is kept free at a twist: smaller for a turn on the spot.
double margin_m(const types::Twist2& twist, const types::RobotLimits& limits, const StopZoneParams& params) {
  return is_on_the_spot(twist, params) ? std::min(limits.turn_margin_m, limits.margin_m) : limits.margin_m;
}

}  // namespace

double forward_valid_fraction(const Scan& scan, const types::Se2& T_base_laser,
                              const StopZoneParams& params) {
  const double sector_rad = params.forward_sector_rad;
  std::size_t forward = 0, valid = 0;
  for (std::size_t i = 0; i < scan.beams; ++i) {
    if (!is_forward(scan, T_base_laser, i, sector_rad)) continue;
    ++forward;
    if (is_valid_range(scan.range_m[i])) ++valid;
  }
  const double needed = std::max(beams_of_sector(scan.geometry, sector_rad), static_cast<double>(forward));
  return needed > 0.0 ? static_cast<double>(valid) / needed : 0.0;
}

std::size_t scan_points(const Scan& scan, const types::Se2& T_base_laser, const StopZoneParams& params,
                        std::span<ScanPoint> out) {
  std::size_t count = 0;
  for_each_obstacle(scan, T_base_laser, params, [&](const Vector2& p, bool forward) {
    if (count < out.size()) out[count++] = {p, forward};
  });
  return count;
}

double free_time_s(const types::Twist2& twist, const types::RobotLimits& limits, const Surroundings& around) {
  if (!std::isfinite(twist.v_mps) || !std::isfinite(twist.omega_radps)) return 0.0;
  const double keep_m = margin_m(twist, limits, around.params);
  const ContactParams& contact = around.params.contact;
  // Where the hull has just been, only new arrivals can stand: a point within the noise must not stop the
  // robot.
  const bool along_trail = around.backing_off && twist.v_mps < 0.0;
  const types::Footprint slim = types::grown(limits.footprint, -contact.noise_m);
  FirstContact first(twist, types::reach_m(types::grown(limits.footprint, keep_m)));
  const auto shorten = [&](const Vector2& p) {
    first.offer(p, [&] {
      return along_trail ? contact_time_s(p, twist, slim)
                         : contact_time_with_margin_s(p, twist, limits.footprint, keep_m, contact);
    });
  };
  for_each_echo(limits, around, shorten);
  for_each_scan_point(limits, around, shorten);
  return first.seconds();
}

double slip_free_time_s(const types::Twist2& twist, const types::RobotLimits& limits,
                        const Surroundings& around) {
  if (!(twist.v_mps > 0.0)) return kNever_s;
  const double turn_radps = limits.slip_curvature_per_m * twist.v_mps;
  const Twist2 left{twist.v_mps, twist.omega_radps + turn_radps};
  const Twist2 right{twist.v_mps, twist.omega_radps - turn_radps};
  FirstContact first(twist, types::reach_m(limits.footprint));
  const auto shorten = [&](const Vector2& p) {
    first.offer(p, [&] {
      return std::min(contact_time_s(p, left, limits.footprint), contact_time_s(p, right, limits.footprint));
    });
  };
  for_each_echo(limits, around, shorten);
  for_each_scan_point(limits, around, shorten);
  return first.seconds();
}

bool is_on_the_spot(const types::Twist2& twist, const StopZoneParams& params) {
  return std::abs(twist.v_mps) < params.on_the_spot_mps;
}

double remembered_gap_m(const types::RobotLimits& limits, const Surroundings& around, double far_m) {
  const double reach = types::reach_m(limits.footprint) + far_m;
  double least_m = far_m;
  for (const ScanPoint& point : around.points) {
    if (point.remembered && point.p_base.squaredNorm() < reach * reach)
      least_m = std::min(least_m, distance_m(point.p_base, limits.footprint));
  }
  return least_m;
}

std::size_t collect_obstacles(const types::RobotLimits& limits, const Surroundings& around, double reach_m,
                              double spacing_m, std::span<Vector2> out) {
  std::size_t count = 0;
  const auto keep = [&](const Vector2& p) {
    if (count == out.size() || !(p.squaredNorm() < reach_m * reach_m)) return;
    if (count > 0 && (p - out[count - 1]).squaredNorm() < spacing_m * spacing_m) return;
    out[count++] = p;
  };
  for_each_echo(limits, around, keep);
  for_each_scan_point(limits, around, keep);
  return count;
}

double free_distance_m(const types::Twist2& twist, double free_time_s) {
  if (free_time_s == 0.0) return 0.0;
  return twist.v_mps == 0.0 ? kNever_s : std::abs(twist.v_mps) * free_time_s;
}

}  // namespace topo::perception
