// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/hokuyo/sensor_clock.hpp"

#include <algorithm>
#include <cmath>

namespace topo::hokuyo {
namespace {

using types::Duration;
using types::Stamp;

constexpr std::int64_t kNsPerMs = 1'000'000;
constexpr std::int64_t kWrapMs = std::int64_t{1} << 24;
constexpr std::int64_t kWindowMs = 10'000;
/// Duration of learning the difference between TM1 and the running minimum: 100 ppm are 0.2 ms in 2 s.
constexpr std::int64_t kCalibrationMs = 2'000;
/// A scan cannot arrive earlier than the fastest one; when it seems to by more than this, the device's clock
/// was set forward.
constexpr std::int64_t kTooEarlyNs = 50 * kNsPerMs;
/// No link delays a scan by this much and remains open.
constexpr std::int64_t kTooLateNs = 5'000 * kNsPerMs;
constexpr std::int64_t kMaxLatencyNs = 250 * kNsPerMs;
/// Crystals are within 100 ppm; one UTM-30LX firmware had a gross error (PROTOCOLS section 12).
constexpr double kMaxDrift = 5e-3;
constexpr std::size_t kMinWindows = 3;
constexpr int kFrozenRepeats = 2;

std::int64_t difference_ns(Stamp host, std::int64_t device_ms) {
  return host.time_since_epoch().count() - device_ms * kNsPerMs;
}

}  // namespace

void SensorClock::reset(Duration nominal_latency) {
  *this = SensorClock{};
  latency_ns_ = nominal_latency.count();
}

void SensorClock::add_round_trip(std::uint32_t counter_ms, Stamp before, Stamp after) {
  const Duration round_trip = after - before;
  if (round_trip < Duration::zero() || (synchronised_ && round_trip >= best_round_trip_)) return;
  bool stepped_back = false;
  last_ms_ = unwrap(counter_ms, stepped_back);
  synchronised_ = true;
  best_round_trip_ = round_trip;
  sync_ = {last_ms_, difference_ns(before + round_trip / 2, last_ms_)};
}

/// A small step back means a restart of the device, a large one a wrap of the counter.
std::int64_t SensorClock::unwrap(std::uint32_t counter_ms, bool& stepped_back) const {
  const std::int64_t turn = last_ms_ / kWrapMs * kWrapMs;
  std::int64_t unwrapped = turn + counter_ms;
  if (unwrapped < last_ms_ - kWrapMs / 2) unwrapped += kWrapMs;
  stepped_back = unwrapped < last_ms_;
  return unwrapped;
}

std::int64_t SensorClock::projected(const Point& point, std::int64_t device_ms) const {
  const double drifted_ns = drift_ * static_cast<double>((device_ms - point.device_ms) * kNsPerMs);
  return point.difference_ns + std::llround(drifted_ns);
}

std::int64_t SensorClock::minimum_at(std::int64_t device_ms) const {
  std::int64_t lowest = projected(bucket_[newest_], device_ms);
  for (std::size_t i = 0; i < buckets_; ++i) lowest = std::min(lowest, projected(bucket_[i], device_ms));
  return lowest;
}

bool SensorClock::implausible(std::int64_t difference, std::int64_t device_ms) const {
  const std::int64_t above = difference - minimum_at(device_ms);
  return above < -kTooEarlyNs || above > kTooLateNs;
}

void SensorClock::restart(const Point& point) {
  started_ = true;
  start_ms_ = point.device_ms;
  bucket_[0] = point;
  buckets_ = 1;
  newest_ = 0;
  bucket_end_ms_ = point.device_ms + kBucketMs;
  window_minimum_ = point;
  window_end_ms_ = point.device_ms + kWindowMs;
  windows_ = 0;  // the drift is kept: it depends on the crystals, not on the counter's value
}

void SensorClock::add(const Point& point) {
  if (point.device_ms >= bucket_end_ms_) {
    newest_ = (newest_ + 1) % kBuckets;
    buckets_ = std::min(buckets_ + 1, kBuckets);
    bucket_[newest_] = point;
    bucket_end_ms_ = point.device_ms + kBucketMs;
  } else if (point.difference_ns < projected(bucket_[newest_], point.device_ms)) {
    bucket_[newest_] = point;
  }
  if (point.device_ms >= window_end_ms_) {
    close_window();
    window_minimum_ = point;
    window_end_ms_ = point.device_ms + kWindowMs;
  } else if (point.difference_ns < projected(window_minimum_, point.device_ms)) {
    window_minimum_ = point;
  }
}

void SensorClock::close_window() {
  window_[windows_ % kWindows] = window_minimum_;
  ++windows_;
  if (windows_ >= kMinWindows) fit_drift();
}

/// Least squares over the window minima.
void SensorClock::fit_drift() {
  const std::size_t count = std::min(windows_, kWindows);
  const Point origin = window_[0];
  double mean_t = 0.0, mean_d = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    mean_t += static_cast<double>((window_[i].device_ms - origin.device_ms) * kNsPerMs);
    mean_d += static_cast<double>(window_[i].difference_ns - origin.difference_ns);
  }
  mean_t /= static_cast<double>(count);
  mean_d /= static_cast<double>(count);
  double spread = 0.0, product = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const double t = static_cast<double>((window_[i].device_ms - origin.device_ms) * kNsPerMs) - mean_t;
    const double d = static_cast<double>(window_[i].difference_ns - origin.difference_ns) - mean_d;
    spread += t * t;
    product += t * d;
  }
  if (spread > 0.0) drift_ = std::clamp(product / spread, -kMaxDrift, kMaxDrift);
}

/// The constant latency: the fastest arrivals' offset above that of TM1.
void SensorClock::calibrate(const Point& point) {
  if (calibrated_ || !synchronised_) return;
  const std::int64_t latency = minimum_at(point.device_ms) - sync_.difference_ns;
  if (latency < 0 || latency > kMaxLatencyNs) {
    synchronised_ = false;  // TM1 and the scans disagree: the assumed latency is the better estimate
    return;
  }
  latency_ns_ = latency;
  calibrated_ = point.device_ms - start_ms_ >= kCalibrationMs;
}

/// A device whose clock was set looks late; TM1 tells the difference, before the next stream (reset()). Of a
/// round trip it is not known which way took how long: all of it counts as the way to here, so that a line
/// that is late from the beginning is known, and one that is late to the device is taken for it.
Duration SensorClock::wait_of(const Point& point, Stamp arrival) {
  const Duration asked =
      Duration(sync_.difference_ns) - best_round_trip_ / 2;  // the device was read no earlier
  if (!age_begun_ && synchronised_) age_.begin(asked + Duration(latency_ns_), arrival);
  age_begun_ = true;
  return age_.update(Duration(point.difference_ns), arrival);
}

SensorClock::Result SensorClock::on_scan(std::uint32_t counter_ms, Stamp arrival) {
  Result result;
  bool stepped_back = false;
  result.device_ms = unwrap(counter_ms, stepped_back);
  if (started_ && result.device_ms == last_ms_) {
    result.repeated = true;
    result.frozen = ++repeats_ >= kFrozenRepeats;
  } else {
    repeats_ = 0;
  }
  if (stepped_back) result.device_ms = counter_ms;
  const Point point{result.device_ms, difference_ns(arrival, result.device_ms)};
  result.jumped = started_ && (stepped_back || implausible(point.difference_ns, point.device_ms));
  if (result.jumped) calibrated_ = true;  // TM1 measured the old counter; the latency is kept
  if (!started_ || result.jumped) {
    restart(point);
  } else if (!result.repeated) {
    add(point);
  }
  result.late = wait_of(point, arrival);
  last_ms_ = result.device_ms;
  calibrate(point);
  result.host = Stamp{Duration(minimum_at(point.device_ms) - latency_ns_ + point.device_ms * kNsPerMs)};
  return result;
}

}  // namespace topo::hokuyo
