// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include "core/types/scan.hpp"
#include "core/types/se2.hpp"

namespace topo::perception {

/// One sweep as if measured at one instant, in the sensor's frame at its middle beam: of a sensor that turns,
/// the beams lie closer or wider. What it drives within half a sweep, below 1 cm, is left out. Fixed size;
/// the arrays are filled up to `beams`.
struct ScanLook {          // NOLINT(cppcoreguidelines-pro-type-member-init)
  types::Stamp stamp{};    ///< of the middle beam
  double first_rad = 0.0;  ///< bearing of beam 0
  double step_rad = 0.0;   ///< between neighbours, positive
  double range_max_m = 0.0;
  std::size_t beams = 0;
  std::array<float, types::Scan::kMaxBeams> range_m;          ///< as in the scan
  std::array<types::Vector2, types::Scan::kMaxBeams> points;  ///< of hits; others are not set

  [[nodiscard]] bool is_hit(std::size_t beam) const { return types::is_hit(range_m[beam]); }
  /// Beam nearest to a point's bearing; `beams` when it looks nowhere near.
  [[nodiscard]] std::size_t beam_towards(const types::Vector2& p) const;
  /// How far the beams towards a disc that small saw nothing, metres; 0 where one of them says nothing.
  [[nodiscard]] double clear_towards_m(const types::Vector2& p, double radius_m) const;
};

/// False, and `out` without meaning, for a scan that has no beams in order.
bool take_look(const types::Scan& scan, double omega_radps, ScanLook& out);

}  // namespace topo::perception
