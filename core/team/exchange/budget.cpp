// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/team/exchange/budget.hpp"

#include <algorithm>

namespace topo::team {
namespace {

/// SplitMix64 (Steele, Lea and Flood 2014): the next number from a state.
std::uint64_t next_of(std::uint64_t& state) {
  state += 0x9E3779B97F4A7C15ULL;
  std::uint64_t z = state;
  z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
  return z ^ (z >> 31U);
}

}  // namespace

void ByteBudget::refill(double rate_bytes_per_s, double burst_bytes, types::Stamp now) {
  if (begun_ && now > last_) bytes_ += rate_bytes_per_s * types::to_seconds(now - last_);
  bytes_ = std::min(bytes_, burst_bytes);
  last_ = begun_ ? std::max(last_, now) : now;
  begun_ = true;
}

void Periodic::done(types::Stamp now, double period_s, double jitter) {
  const double share = static_cast<double>(next_of(state_) >> 11U) / 9007199254740992.0;  // 2^53
  next_ = now + types::from_seconds(period_s * (1.0 + jitter * (2.0 * share - 1.0)));
}

}  // namespace topo::team
