// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "core/types/stamp.hpp"

namespace topo::pioneer {

/// GYROpac (PROTOCOLS section 5): readings since the packet before, in units of the converter.
struct GyroPacket {
  static constexpr std::size_t kMaxReadings = 64;  ///< the most that the longest packet holds
  std::size_t count = 0;
  std::array<std::uint16_t, kMaxReadings> reading{};
};

/// Nothing for another type, and for a packet that ends before its readings do.
std::optional<GyroPacket> decode_gyro(std::span<const std::byte> payload);

struct GyroParams {
  /// Per unit: 10 bits of 5 V, 2.5 V for 300 degrees/s, and the scale 1.626 that ARIA's files have for the
  /// P3-AT and P3-DX (GyroScaler).
  double degps_per_unit = 5.0 / 1023.0 * 300.0 / 2.5 * 1.626;
  double rest_units = 2.5;         ///< readings of a standing robot are this near to their mean (ARIA: 0.5 %)
  double still_units = 2.0;        ///< a standing robot's mean this near to rest is no turn
  double rest_range_units = 60.0;  ///< of the middle of the range: further off is a broken sensor
  std::size_t rest_readings = 25;  ///< at least, and
  types::Duration rest_time = std::chrono::seconds(1);  ///< for so long, until the rest is known
  std::uint16_t lowest = 20, highest = 1003;            ///< beyond, the converter is at its end
};

/// Turn of the robot by its gyro. The reading at rest drifts with temperature: it is measured whenever the
/// wheels stand. Until it was, the gyro gives nothing.
class Gyro {
 public:
  explicit Gyro(const GyroParams& params = {}) : params_(params) {}

  void take(const GyroPacket& packet);
  /// At a status: the turn, counter-clockwise, in the time since the one before, by the mean of the readings
  /// that came in it. Nothing without readings, with readings at the end of the range, when `faulty`, and
  /// before the rest is known. `wheels_stand`: no wheel has moved since the status before.
  std::optional<double> turn_rad(types::Duration elapsed, bool wheels_stand, bool faulty);
  /// The reading at rest, once known.
  [[nodiscard]] std::optional<double> rest() const { return rest_; }

 private:
  void learn_rest(double mean, std::size_t count, types::Duration elapsed);
  void forget_window();

  GyroParams params_;
  std::optional<double> rest_;
  double sum_ = 0.0;  ///< of the readings since the last status
  std::size_t count_ = 0;
  bool clipped_ = false;
  double window_sum_ = 0.0;  ///< of the readings since the robot stands
  std::size_t window_count_ = 0;
  types::Duration window_time_{};
};

}  // namespace topo::pioneer
