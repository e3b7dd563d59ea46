// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include "core/types/scan.hpp"
#include "core/types/se2.hpp"

namespace topo::perception {

/// One sweep as if measured at one instant, in the sensor's frame at its middle beam: when the sensor turns,
/// the beams lie closer or wider. Translation within half a sweep, below 1 cm for a sweep of 25 ms, is
/// neglected. Fixed size; the arrays are filled up to `beams`.
struct ScanLook {          // NOLINT(cppcoreguidelines-pro-type-member-init)
  types::Stamp stamp{};    ///< of the middle beam
  double first_rad = 0.0;  ///< bearing of beam 0
  double step_rad = 0.0;   ///< between neighbours, positive
  double range_max_m = 0.0;
  std::size_t beams = 0;
  std::array<float, types::Scan::kMaxBeams> range_m;          ///< as in the scan
  std::array<types::Vector2, types::Scan::kMaxBeams> points;  ///< of hits; others are not set

  [[nodiscard]] bool is_hit(std::size_t beam) const { return types::is_hit(range_m[beam]); }
  /// Beam nearest to a point's bearing; `beams` when the point is out of view.
  [[nodiscard]] std::size_t beam_towards(const types::Vector2& p) const;
  /// Free distance along the beams towards a disc of `radius_m` at `p`, metres; 0 when `p` is out of view or
  /// one of the beams is invalid.
  [[nodiscard]] double clear_towards_m(const types::Vector2& p, double radius_m) const;
};

/// Clockwise beams are taken in the other order. False, with `out` undefined, for a scan with fewer than two
/// beams or whose beams do not go on.
bool take_look(const types::Scan& scan, double omega_radps, ScanLook& out);

}  // namespace topo::perception
