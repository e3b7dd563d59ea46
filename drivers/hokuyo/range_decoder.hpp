// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "drivers/hokuyo/identity.hpp"

namespace topo::hokuyo {

/// Converts raw numbers to metres or to "no distance" (PROTOCOLS section 10.2). A number below the sensor's
/// minimum is a code, never a distance.
class RangeDecoder {
 public:
  /// No Hokuyo measures below, and all their codes are below (PROTOCOLS section 10.2), also where DMIN is 0.
  static constexpr int kLeast_mm = 20;

  RangeDecoder() = default;
  RangeDecoder(Family family, int distance_min_mm, int distance_max_mm);

  [[nodiscard]] float operator()(std::uint32_t raw) const {
    if (raw >= min_mm_ && raw <= max_mm_) return static_cast<float>(raw) * 0.001F;
    if (raw > max_mm_) return types::kNoReturn;  // includes 65533 of the EW and UST
    return code(raw);
  }

 private:
  [[nodiscard]] float code(std::uint32_t raw) const;

  Family family_ = Family::kUnknown;
  std::uint32_t min_mm_ = 1;
  std::uint32_t max_mm_ = 0;
};

}  // namespace topo::hokuyo
