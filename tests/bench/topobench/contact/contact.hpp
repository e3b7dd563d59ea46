// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/team/exchange/exchange.hpp"

namespace topo::bench {

/// Robots that were apart, and meet.
struct ContactSetup {
  int robots = 3;
  std::uint32_t keyframes = 5'600;     ///< that each made while apart: an hour at 1.6 a second
  std::size_t keyframe_bytes = 4'300;  ///< encoded, on average
  double loss = 0.3;                   ///< of datagrams, for each receiver by itself
  double delay_s = 0.02;
  double limit_s = 1'000.0;  ///< after contact
  double steady_s = 120.0;   ///< afterwards: all go on making keyframes
  double keyframes_hz = 1.6;
  std::uint64_t seed = 1;
  team::RateParams rates;
};

struct ContactResult {
  bool same_sets = false;
  double same_after_s = 0.0;  ///< contact: all hold everything
  std::array<double, 3>
      shares_s{};  ///< until 10, 50 and 90 % of what was lacking was held by those who lacked it
  double catch_up_bytes_per_s = 0.0;  ///< a robot
  double repeated = 0.0;              ///< share of the pieces that came and were held already
  std::size_t assembly_bytes_max = 0;
  double steady_bytes_per_s = 0.0;  ///< a robot, when all have all
  double steady_lag_s =
      0.0;  ///< greatest time from a keyframe's making until all hold it, in the steady part
  std::array<double, team::kMessageKinds> steady_bytes_per_s_of{};
  double cpu_s = 0.0;
};

[[nodiscard]] ContactResult run_contact(const ContactSetup& setup);

}  // namespace topo::bench
