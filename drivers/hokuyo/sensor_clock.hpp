// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/types/stamp.hpp"
#include "drivers/io/line_age.hpp"

namespace topo::hokuyo {

/// Maps the sensor's 24-bit millisecond counter to the host's steady clock (PROTOCOLS section 12).
///
/// At connect, round trips of TM1 give the offset; the one with the smallest round trip is used. While
/// streaming, arrival - device time is the offset plus a latency that is never below a constant. The running
/// minimum over 10 s, extrapolated with the estimated drift, follows the drift of the two crystals; its
/// difference from the TM1 offset in the first seconds is that constant. Without TM1 the constant is assumed.
/// Sans-I/O; allocates nothing.
class SensorClock {
 public:
  struct Result {
    types::Stamp host{};         ///< host time of this counter value
    std::int64_t device_ms = 0;  ///< unwrapped
    types::Duration late{};      ///< wait on the line beyond the shortest (io::LineAge)
    bool jumped = false;         ///< the device's clock was set or the device restarted: gaps are meaningless
    bool repeated = false;       ///< the same value as before
    bool frozen = false;         ///< the same value three times: the counter has stopped
  };

  /// `nominal_latency`: from the counter's reading to the arrival, assumed when TM1 does not work.
  void reset(types::Duration nominal_latency);

  /// Adds one TM1 exchange: request at `before`, reply at `after`.
  void add_round_trip(std::uint32_t counter_ms, types::Stamp before, types::Stamp after);
  [[nodiscard]] bool synchronised() const { return synchronised_; }
  [[nodiscard]] types::Duration best_round_trip() const { return best_round_trip_; }

  /// A scan with this counter value whose bytes arrived at `arrival`.
  Result on_scan(std::uint32_t counter_ms, types::Stamp arrival);

  /// Drift of the host's clock against the device's, in seconds per second; 0 until known.
  [[nodiscard]] double drift() const { return drift_; }
  /// Latency from the counter's reading to the fastest arrival.
  [[nodiscard]] types::Duration latency() const { return types::Duration(latency_ns_); }

 private:
  struct Point {
    std::int64_t device_ms = 0;
    std::int64_t difference_ns = 0;  ///< arrival - device time
  };
  static constexpr std::size_t kBuckets = 10;
  static constexpr std::int64_t kBucketMs = 1000;
  static constexpr double kMaxAgeRise = 200e-6;  ///< two crystals of 100 ppm each
  static constexpr std::size_t kWindows = 12;    ///< two minutes of 10 s windows for the drift

  [[nodiscard]] std::int64_t unwrap(std::uint32_t counter_ms, bool& stepped_back) const;
  [[nodiscard]] bool implausible(std::int64_t difference_ns, std::int64_t device_ms) const;
  [[nodiscard]] std::int64_t minimum_at(std::int64_t device_ms) const;
  [[nodiscard]] std::int64_t projected(const Point& point, std::int64_t device_ms) const;
  void add(const Point& point);
  void close_window();
  void fit_drift();
  void restart(const Point& point);
  void calibrate(const Point& point);
  types::Duration wait_of(const Point& point, types::Stamp arrival);

  bool synchronised_ = false;
  types::Duration best_round_trip_{};
  Point sync_;  ///< from the middle of the best round trip

  bool started_ = false;
  bool calibrated_ = false;
  std::int64_t start_ms_ = 0;
  std::int64_t last_ms_ = 0;
  int repeats_ = 0;
  std::int64_t latency_ns_ = 0;

  std::array<Point, kBuckets> bucket_{};  ///< minimum of each of the last seconds, a ring buffer
  std::size_t buckets_ = 0;
  std::size_t newest_ = 0;
  std::int64_t bucket_end_ms_ = 0;

  Point window_minimum_;
  std::int64_t window_end_ms_ = 0;
  std::array<Point, kWindows> window_{};
  std::size_t windows_ = 0;  ///< closed since the start or the last jump
  double drift_ = 0.0;

  io::LineAge age_{kMaxAgeRise};
  bool age_begun_ = false;
};

}  // namespace topo::hokuyo
