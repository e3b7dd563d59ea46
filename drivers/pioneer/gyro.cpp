// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/pioneer/gyro.hpp"

#include <cmath>

#include "core/types/bytes.hpp"
#include "core/types/se2.hpp"
#include "drivers/pioneer/arcos_codec.hpp"

namespace topo::pioneer {
namespace {

constexpr double kMiddle = 512.0;

}  // namespace

std::optional<GyroPacket> decode_gyro(std::span<const std::byte> payload) {
  types::ByteReader in(payload);
  if (in.optional<std::uint8_t>() != static_cast<std::uint8_t>(PacketType::kGyro)) return std::nullopt;
  const auto count = in.optional<std::uint8_t>();
  if (!count || *count > GyroPacket::kMaxReadings) return std::nullopt;
  GyroPacket out;
  out.count = *count;
  for (std::size_t i = 0; i < out.count; ++i) {
    out.reading[i] = in.integer<std::uint16_t>();
    in.optional<std::uint8_t>();  // temperature: the rest is measured instead
  }
  if (!in.ok()) return std::nullopt;
  return out;
}

void Gyro::take(const GyroPacket& packet) {
  for (std::size_t i = 0; i < packet.count; ++i) {
    sum_ += packet.reading[i];
    clipped_ = clipped_ || packet.reading[i] < params_.lowest || packet.reading[i] > params_.highest;
  }
  count_ += packet.count;
}

void Gyro::forget_window() {
  window_sum_ = 0.0;
  window_count_ = 0;
  window_time_ = {};
}

void Gyro::learn_rest(double mean, std::size_t count, types::Duration elapsed) {
  const bool alone = window_count_ == 0;
  const double before = alone ? mean : window_sum_ / static_cast<double>(window_count_);
  // Wheels stand and the robot turns: it is carried, or on a turntable.
  if (std::abs(mean - before) > params_.rest_units) forget_window();
  window_sum_ += mean * static_cast<double>(count);
  window_count_ += count;
  window_time_ += elapsed;
  if (window_count_ < params_.rest_readings || window_time_ < params_.rest_time) return;
  const double found = window_sum_ / static_cast<double>(window_count_);
  forget_window();
  if (std::abs(found - kMiddle) > params_.rest_range_units) return;
  // A slow, steady turn of a standing robot must not become its rest.
  if (!rest_ || std::abs(found - *rest_) <= params_.still_units) rest_ = found;
}

std::optional<double> Gyro::turn_rad(types::Duration elapsed, bool wheels_stand, bool faulty) {
  const std::size_t count = count_;
  const double mean = count == 0 ? 0.0 : sum_ / static_cast<double>(count);
  const bool usable = count > 0 && !clipped_ && !faulty;
  sum_ = 0.0;
  count_ = 0;
  clipped_ = false;
  if (usable && wheels_stand)
    learn_rest(mean, count, elapsed);
  else
    forget_window();
  if (!usable || !rest_) return std::nullopt;
  const double off = mean - *rest_;
  if (wheels_stand && std::abs(off) < params_.still_units) return 0.0;
  return -off * params_.degps_per_unit * types::kDegree_rad * types::to_seconds(elapsed);
}

}  // namespace topo::pioneer
