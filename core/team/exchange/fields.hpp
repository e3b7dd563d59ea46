// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "core/types/bytes.hpp"
#include "core/types/se2.hpp"

// Fields that several codecs of the exchange have.
namespace topo::team {

/// Coordinates from outside are at most so far from the origin.
inline constexpr double kPlaceReach_m = 1e5;

[[nodiscard]] inline bool is_in_reach(double value) { return std::abs(value) <= kPlaceReach_m; }
[[nodiscard]] inline bool is_in_reach(const types::Vector2& p) {
  return is_in_reach(p.x()) && is_in_reach(p.y());
}

inline void write_place(types::ByteWriter& out, const types::Vector2& p) {
  out.real(p.x());
  out.real(p.y());
}

/// `ok` becomes false for a place that is not finite or out of reach.
[[nodiscard]] inline types::Vector2 read_place(types::ByteReader& in, bool& ok) {
  const double x = in.real64(), y = in.real64();
  types::Vector2 p(x, y);
  ok = ok && in.ok() && is_in_reach(p);
  return p;
}

}  // namespace topo::team
