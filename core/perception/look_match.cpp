// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/perception/look_match.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace topo::perception {
namespace {

using types::Se2;
using types::Vector2;

/// The surface that a sweep measured in the direction of a point, as a line.
struct Line {
  Vector2 on{0.0, 0.0}, normal{0.0, 0.0};
};

bool line_towards(const ScanLook& look, const Vector2& p, const LookMatchParams& params, Line& line) {
  const std::size_t beam = look.beam_towards(p);
  if (beam >= look.beams || !look.is_hit(beam)) return false;
  const double range_m = static_cast<double>(look.range_m[beam]);
  const double beside = params.beside_m / (range_m * look.step_rad + 1e-9);  // beams; 1e-9: not by zero
  const auto aside = static_cast<std::size_t>(std::clamp(beside, 1.0, params.beside_beams_max));
  if (beam < aside || beam + aside >= look.beams) return false;
  if (!look.is_hit(beam - aside) || !look.is_hit(beam + aside)) return false;
  const Vector2 &a = look.points[beam - aside], &b = look.points[beam + aside];
  const Vector2 way = b - a;
  const double length_m = way.norm();
  if (!(length_m > 0.0 && length_m < params.corner_m)) return false;
  line.normal = Vector2(-way.y(), way.x()) / length_m;
  line.on = (a + b + look.points[beam]) / 3.0;
  return true;
}

/// Normal equations of one round.
struct Sum {
  Eigen::Matrix3d lhs = Eigen::Matrix3d::Zero();
  Eigen::Vector3d rhs = Eigen::Vector3d::Zero();
  std::size_t compared = 0, fitting = 0;

  void add(const Vector2& p, const Line& line, double scale_m, const LookMatchParams& params) {
    const double off_m = line.normal.dot(p - line.on);
    if (!(std::abs(off_m) < params.far_m)) return;
    ++compared;
    if (std::abs(off_m) < params.fits_m) ++fitting;
    const double part = 1.0 / (1.0 + off_m * off_m / (scale_m * scale_m));
    const Eigen::Vector3d row(line.normal.x(), line.normal.y(),
                              line.normal.y() * p.x() - line.normal.x() * p.y());
    lhs += part * part * row * row.transpose();
    rhs -= part * part * off_m * row;
  }
  void hold(const Se2& correction, const LookMatchParams& p) {
    const double along = p.scale_m * p.scale_m / (p.guess_m * p.guess_m);
    const Eigen::Vector3d weight(along, along, p.scale_m * p.scale_m / (p.guess_rad * p.guess_rad));
    lhs.diagonal() += weight;
    rhs -= weight.cwiseProduct(Eigen::Vector3d(correction.x_m, correction.y_m, correction.theta_rad));
  }
};

Sum compare(const ScanLook& before, const ScanLook& now, const Se2& T_before_now, double scale_m,
            const LookMatchParams& params) {
  Sum sum;
  const double c = std::cos(T_before_now.theta_rad), s = std::sin(T_before_now.theta_rad);
  const std::size_t stride = std::max<std::size_t>(1, (now.beams + params.compared - 1) / params.compared);
  for (std::size_t i = 0; i < now.beams; i += stride) {
    if (!now.is_hit(i)) continue;
    const Vector2& q = now.points[i];
    const Vector2 p(T_before_now.x_m + c * q.x() - s * q.y(), T_before_now.y_m + s * q.x() + c * q.y());
    Line line;
    if (line_towards(before, p, params, line)) sum.add(p, line, scale_m, params);
  }
  return sum;
}

}  // namespace

LookMatch match_looks(const ScanLook& before, const ScanLook& now, const Se2& guess,
                      const LookMatchParams& params) {
  constexpr double kSettled_m = 1e-3, kSettled_rad = 5e-4;  // numerical: a smaller step changes nothing
  Se2 correction;
  Sum sum;
  for (int round = 0; round < params.rounds; ++round) {
    const double scale_m = round < params.coarse_rounds ? params.coarse_m : params.scale_m;
    sum = compare(before, now, correction * guess, scale_m, params);
    if (round + 1 == params.rounds) break;
    sum.hold(correction, params);
    const Eigen::Vector3d step = sum.lhs.ldlt().solve(sum.rhs);
    correction = Se2{step.x(), step.y(), step.z()} * correction;
    if (round >= params.coarse_rounds && step.head<2>().norm() < kSettled_m &&
        std::abs(step.z()) < kSettled_rad)
      break;
  }
  const double explained =
      sum.compared > 0 ? static_cast<double>(sum.fitting) / static_cast<double>(sum.compared) : 0.0;
  return {correction * guess, explained};
}

}  // namespace topo::perception
