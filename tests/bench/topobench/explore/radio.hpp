// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "core/types/result.hpp"
#include "core/types/se2.hpp"
#include "tests/sim/random.hpp"

namespace topo::bench {

/// What becomes of a letter between two robots.
struct RadioParams {
  bool silent = false;
  double range_m = HUGE_VAL;  ///< straight, through walls
  double loss = 0.0;          ///< of letters, each for itself
};

/// "perfect", "none", "range:15" (metres) or "loss:0.3" (share of letters).
types::Result<RadioParams> parse_radio(const std::string& text);

/// Decides letter by letter; the same seed decides the same.
class Radio {
 public:
  Radio(const RadioParams& params, std::uint64_t seed) : params_(params), random_(seed) {}
  /// Does a letter from the one place get to the other?
  bool carries(const types::Vector2& from, const types::Vector2& to);

 private:
  RadioParams params_;
  sim::Random random_;
};

}  // namespace topo::bench
