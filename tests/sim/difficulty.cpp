// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/sim/difficulty.hpp"

#include <fmt/format.h>

namespace topo::sim {

Difficulty Difficulty::none() {
  Difficulty d;
  d.range_sigma_near_m = d.range_sigma_far_m = 0.0;
  d.dropout_probability = d.mixed_pixel_probability = 0.0;
  d.glass_transparent = false;
  d.wheel_scale_error = d.track_error = 0.0;
  d.slip_interval_s = 0.0;
  d.sonar_relative_sigma = d.sonar_dropout_probability = 0.0;
  return d;
}

std::string Difficulty::text() const {
  const std::string slip = slip_interval_s > 0.0
                               ? fmt::format(
                                     "slip bursts every {:g} s of driving (mean), {:g} to {:g} s long, {:g} "
                                     "to {:g} % of a wheel's travel lost",
                                     slip_interval_s, slip_duration_min_s, slip_duration_max_s,
                                     100.0 * slip_loss_min, 100.0 * slip_loss_max)
                               : std::string("no slip");
  return fmt::format(
      "{}difficulty: range noise {:g} mm to {:g} m and {:g} mm beyond; {:g} % dropouts; mixed pixels at {:g} "
      "% of "
      "depth edges over {:g} m; glass {}; wheel scale errors {:g} %, track error {:g} %{}; {}; sonar noise "
      "{:g} %, {:g} % dropouts",
      *this == Difficulty{} ? "" : "CHANGED ", 1e3 * range_sigma_near_m, range_sigma_split_m,
      1e3 * range_sigma_far_m, 100.0 * dropout_probability, 100.0 * mixed_pixel_probability,
      mixed_pixel_step_m, glass_transparent ? "by scene" : "opaque", 100.0 * wheel_scale_error,
      100.0 * track_error, skid > 0.0 ? fmt::format(", skid {:g} % of every turn", 100.0 * skid) : "", slip,
      100.0 * sonar_relative_sigma, 100.0 * sonar_dropout_probability);
}

}  // namespace topo::sim
