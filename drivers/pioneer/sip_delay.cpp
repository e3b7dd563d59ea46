// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/pioneer/sip_delay.hpp"

#include <algorithm>
#include <cmath>

namespace topo::pioneer {
namespace {

constexpr double kRateGain = 0.25;    ///< per block, so that one bad minimum has little effect
constexpr double kForgotten = 600.0;  ///< cycles of silence after which the estimates are discarded

}  // namespace

SipDelay::SipDelay(types::Duration cycle) : cycle_s_(types::to_seconds(cycle)) {}

void SipDelay::restart(types::Stamp sent) {
  anchor_ = sent;
  index_ = 0;
  count_ = 0;
  started_ = true;
  line_age_.reset();
}

/// The lower envelope of the lateness, extrapolated to `index` at the robot's estimated clock rate.
double SipDelay::envelope(std::int64_t index) const {
  double low = HUGE_VAL;
  for (std::size_t i = 0; i < std::min(count_, kWindow); ++i) {
    const Sample& s = window_[i];
    low = std::min(low, s.lateness_s + rate_s_ * static_cast<double>(index - s.index));
  }
  return low;
}

void SipDelay::add(const Sample& sample) {
  window_[count_ % kWindow] = sample;
  const std::size_t in_block = count_ % kRateBlock;
  if (in_block == 0 || sample.lateness_s < block_minimum_.lateness_s) block_minimum_ = sample;
  ++count_;
  if (in_block == kRateBlock - 1) learn_rate();
}

void SipDelay::learn_rate() {
  if (count_ > kRateBlock) {
    const auto span = static_cast<double>(block_minimum_.index - previous_minimum_.index);
    const double slope = (block_minimum_.lateness_s - previous_minimum_.lateness_s) / std::max(span, 1.0);
    rate_s_ += kRateGain * (std::clamp(slope, -kRateMax * cycle_s_, kRateMax * cycle_s_) - rate_s_);
  }
  previous_minimum_ = block_minimum_;
}

/// Cycles since the last packet. Lateness adds to them: up to four fifths of a cycle of lateness do not count
/// as a lost packet; one fifth is for arrivals earlier than any before.
std::int64_t SipDelay::cycles_until(types::Stamp sent) const {
  constexpr double kEarly = 0.2;
  const double due_s = envelope(index_) + static_cast<double>(index_) * cycle_s_;
  const double cycles =
      std::floor((types::to_seconds(sent - anchor_) - due_s) / (cycle_s_ + rate_s_) + kEarly);
  return static_cast<std::int64_t>(std::clamp(cycles, 1.0, kForgotten + 1.0));
}

types::Duration SipDelay::update(types::Stamp arrival, types::Duration wire_time) {
  const types::Stamp sent = arrival - wire_time;
  last_step_ = started_ ? cycles_until(sent) : 1;
  if (!started_ || static_cast<double>(last_step_) > kForgotten)
    restart(sent);
  else
    index_ += last_step_;

  double lateness_s = types::to_seconds(sent - anchor_) - static_cast<double>(index_) * cycle_s_;
  // Half a cycle earlier than all before: the packets before were a burst after an interruption, counted
  // wrongly.
  if (count_ > 0 && lateness_s < envelope(index_) - 0.5 * cycle_s_) {
    restart(sent);
    lateness_s = 0.0;
  }
  add({index_, lateness_s});
  const double late_s = std::clamp(lateness_s - envelope(index_), 0.0, cycle_s_);
  age_ = wire_time + types::from_seconds(late_s);
  late_ = line_age_.update(types::from_seconds(lateness_s), arrival);
  return age_;
}

}  // namespace topo::pioneer
