// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/hokuyo/range_decoder.hpp"

#include <algorithm>

namespace topo::hokuyo {

RangeDecoder::RangeDecoder(Family family, int distance_min_mm, int distance_max_mm)
    : family_(family),
      min_mm_(static_cast<std::uint32_t>(std::max(distance_min_mm, kLeast_mm))),
      max_mm_(static_cast<std::uint32_t>(distance_max_mm)) {}

float RangeDecoder::code(std::uint32_t raw) const {
  switch (family_) {
    case Family::kUtm:
    case Family::kUtmEw:
    case Family::kUst:
      if (raw == 1) return types::kNoReturn;
      if (raw == 2 || raw == 4) return types::kTooNear;
      return types::kInvalid;
    case Family::kUrg:
      // 0: perhaps something at 22 m, 6: at 5.7 m; both beyond what it measures.
      return raw == 0 || raw == 6 ? types::kNoReturn : types::kInvalid;
    case Family::kUnknown:
      return types::kInvalid;
  }
  return types::kInvalid;
}

}  // namespace topo::hokuyo
