// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/calibration/robot_numbers.hpp"
#include "core/types/base_state.hpp"

namespace topo::calibration {

/// What the firmware counted, as progress since the first sample: way and turn, from which the travel of each
/// wheel follows whatever the true factors are.
class WheelTrack {
 public:
  WheelTrack(std::span<const types::Odometry> odometry, double model_track_m);

  [[nodiscard]] double model_track_m() const { return model_track_m_; }
  [[nodiscard]] std::size_t size() const { return samples_.size(); }
  [[nodiscard]] double stamp_s(std::size_t i) const { return samples_[i].stamp_s; }
  [[nodiscard]] const types::Progress& counted(std::size_t i) const { return samples_[i].counted; }
  /// Interpolated by a cubic between the samples, because a robot that speeds up is between them where no
  /// straight line leads. Nothing outside the track, nor where samples are missing for half a second.
  [[nodiscard]] std::optional<types::Progress> at(double stamp_s) const;
  /// Index of the last sample at or before the stamp. Precondition: at() has a value there.
  [[nodiscard]] std::size_t before(double stamp_s) const;

 private:
  struct Sample {
    double stamp_s = 0.0;
    types::Progress counted;
  };
  [[nodiscard]] types::Progress rate(std::size_t i) const;

  double model_track_m_;
  std::vector<Sample> samples_;
};

/// The path of base_link that a wheel track means with given factors.
class BasePath {
 public:
  /// `track` must outlive the path.
  BasePath(const WheelTrack& track, const types::WheelCalibration& wheels);
  /// Pose in the frame of the first sample; nothing where WheelTrack::at() has nothing.
  [[nodiscard]] std::optional<types::Se2> at(double stamp_s) const;

 private:
  const WheelTrack& track_;
  types::WheelCalibration wheels_;
  std::vector<types::Se2> poses_;  ///< at the samples
};

/// Motion along an arc of constant curvature.
[[nodiscard]] types::Se2 arc(const types::Progress& progress);

}  // namespace topo::calibration
