// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/plausibility/command_history.hpp"

#include <algorithm>
#include <cmath>

namespace topo::plausibility {
namespace {

double ramped(double last, double wanted, double faster, double slower, double dt_s) {
  const bool slows = std::abs(wanted) < std::abs(last) || wanted * last < 0.0;
  const double step = (slows ? slower : faster) * dt_s;
  return std::clamp(wanted, last - step, last + step);
}

}  // namespace

void CommandHistory::add(types::Stamp now, const types::Twist2& commanded, const types::DriveLimits& limits) {
  const Entry last = count_ > 0 ? entries_[newest_] : Entry{now, {}, {}};
  const double dt_s = std::clamp(types::to_seconds(now - last.stamp), 0.0, params_.elapsed_max_s);
  const types::Twist2 followed{
      ramped(last.followed.v_mps, commanded.v_mps, limits.acceleration_mps2, limits.deceleration_mps2, dt_s),
      ramped(last.followed.omega_radps, commanded.omega_radps, limits.angular_acceleration_radps2,
             limits.angular_acceleration_radps2, dt_s)};
  newest_ = (newest_ + 1) % kMax;
  entries_[newest_] = {now, commanded, followed};
  count_ = std::min(count_ + 1, kMax);
}

const CommandHistory::Entry* CommandHistory::find(types::Stamp time) const {
  for (std::size_t i = 0; i < count_; ++i) {
    const Entry& entry = entries_[(newest_ + kMax - i) % kMax];
    if (entry.stamp <= time) return &entry;
  }
  return nullptr;
}

types::Twist2 CommandHistory::at(types::Stamp time) const {
  const Entry* entry = find(time);
  return entry != nullptr ? entry->commanded : types::Twist2{};
}

types::Twist2 CommandHistory::followed_at(types::Stamp time) const {
  const Entry* entry = find(time);
  return entry != nullptr ? entry->followed : types::Twist2{};
}

}  // namespace topo::plausibility
