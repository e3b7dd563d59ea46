// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "core/types/result.hpp"
#include "core/types/se2.hpp"
#include "tests/sim/random.hpp"

namespace topo::bench {

/// A time in which nothing gets through.
struct RadioCut {
  double from_s = 0.0, to_s = 0.0;
};

/// What becomes of a datagram between two robots.
struct RadioParams {
  bool silent = false;
  double range_m = HUGE_VAL;  ///< straight, through walls
  double loss = 0.0;          ///< of datagrams, each for itself
  double delay_s = 0.1;       ///< that each takes
  std::vector<RadioCut> cuts;
};

/// Items joined by "+": "perfect", "none", "range:15" (metres), "loss:0.3" (share of datagrams), "delay:0.2"
/// (seconds), "cut:120:720" (from and to, seconds), of cuts several.
types::Result<RadioParams> parse_radio(const std::string& text);

/// Decides datagram by datagram; the same seed decides the same.
class Radio {
 public:
  Radio(const RadioParams& params, std::uint64_t seed) : params_(params), random_(seed) {}
  /// Does a datagram from the one place get to the other?
  bool carries(const types::Vector2& from, const types::Vector2& to, double now_s);

 private:
  RadioParams params_;
  sim::Random random_;
};

}  // namespace topo::bench
