// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace topo::sim {

/// Disturbances of the simulated building and robot. The defaults are the project's fixed difficulty: every
/// report states them (text()), and a run with other values is marked as changed.
struct Difficulty {
  // Laser.
  double range_sigma_near_m = 0.030;  ///< up to range_sigma_split_m
  double range_sigma_far_m = 0.050;   ///< beyond that range
  double range_sigma_split_m = 10.0;
  double dropout_probability = 0.01;      ///< half become "no object", half "measurement error"
  double mixed_pixel_probability = 0.30;  ///< of the depth edges between neighbouring beams
  double mixed_pixel_step_m = 0.30;       ///< a smaller step is no depth edge
  bool glass_transparent = true;          ///< as defined by the scene; false: glass is a wall

  // Wheels. Signs are drawn from the seed, sizes are fixed.
  double wheel_scale_error = 0.02;  ///< of each wheel's travel, sign drawn per wheel
  double track_error = 0.05;        ///< of the effective track
  double skid = 0.0;                ///< share of every turn that the wheels count and the robot does not make
  double slip_interval_s = 20.0;    ///< mean driving time between two bursts
  double slip_duration_min_s = 0.2;
  double slip_duration_max_s = 0.8;
  double slip_loss_min = 0.2;  ///< part of the travel that a slipping wheel loses
  double slip_loss_max = 0.6;

  // Sonar.
  double sonar_relative_sigma = 0.01;
  double sonar_dropout_probability = 0.02;

  /// No noise, no slip, no error: for tests of geometry.
  static Difficulty none();

  /// One line for reports.
  [[nodiscard]] std::string text() const;
  friend bool operator==(const Difficulty&, const Difficulty&) = default;
};

}  // namespace topo::sim
