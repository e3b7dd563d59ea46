// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/perception/scan_look.hpp"

#include <algorithm>
#include <cmath>

#include "core/types/beam_directions.hpp"
#include "core/types/invariant.hpp"

namespace topo::perception {

using types::Vector2;

std::size_t ScanLook::beam_towards(const Vector2& p) const {
  const double beam = (std::atan2(p.y(), p.x()) - first_rad) / step_rad;
  if (!(beam > -0.5 && beam < static_cast<double>(beams) - 0.5)) return beams;
  return static_cast<std::size_t>(std::lround(beam));
}

double ScanLook::clear_towards_m(const Vector2& p, double radius_m) const {
  const std::size_t middle = beam_towards(p);
  if (middle == beams) return 0.0;
  const double half = radius_m / std::max(p.norm(), radius_m) / step_rad;
  const auto aside = static_cast<std::size_t>(std::ceil(half));
  const std::size_t begin = middle - std::min(middle, aside), end = std::min(beams, middle + aside + 1);
  double clear_m = range_max_m;
  for (std::size_t i = begin; i < end; ++i) {
    if (range_m[i] == types::kNoReturn) continue;
    if (!is_hit(i)) return 0.0;
    clear_m = std::min(clear_m, static_cast<double>(range_m[i]));
  }
  return clear_m;
}

bool take_look(const types::Scan& scan, double omega_radps, ScanLook& out) {
  const types::ScanGeometry& g = scan.geometry;
  const double between_s = static_cast<double>(g.time_increment_s);
  const double middle = 0.5 * (static_cast<double>(scan.beams) - 1.0);
  types::ScanGeometry turned = g;
  turned.angle_increment_rad += static_cast<float>(omega_radps * between_s);
  out.beams = scan.checked_beams();
  out.step_rad = static_cast<double>(turned.angle_increment_rad);
  out.first_rad = static_cast<double>(g.angle_min_rad) - omega_radps * between_s * middle;
  out.range_max_m = static_cast<double>(g.range_max_m);
  // A sensor that turns faster than its beams go on sees every direction in no order.
  const double own_rad = static_cast<double>(g.angle_increment_rad);
  if (scan.beams < 2 || !(own_rad * out.step_rad > 0.0) || !std::isfinite(out.step_rad) ||
      !std::isfinite(out.first_rad))
    return false;
  out.stamp = scan.first_beam + types::from_seconds(between_s * middle);
  turned.angle_min_rad = static_cast<float>(out.first_rad);
  types::BeamDirections direction(turned, 0.0);
  // A look is counter-clockwise: of a scanner that is mounted upside down the last beam comes first.
  const bool clockwise = out.step_rad < 0.0;
  for (std::size_t i = 0; i < out.beams; ++i, direction.advance()) {
    const std::size_t at = clockwise ? out.beams - 1 - i : i;
    out.range_m[at] = scan.range_m[i];
    if (out.is_hit(at)) out.points[at] = static_cast<double>(scan.range_m[i]) * direction.now();
  }
  if (clockwise) {
    out.first_rad += out.step_rad * static_cast<double>(out.beams - 1);
    out.step_rad = -out.step_rad;
  }
  return true;
}

}  // namespace topo::perception
