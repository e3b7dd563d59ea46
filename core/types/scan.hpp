// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "core/types/invariant.hpp"
#include "core/types/stamp.hpp"

namespace topo::types {

/// Range values that are not distances (REP-117).
inline constexpr float kNoReturn = std::numeric_limits<float>::infinity();  ///< nothing within the range
inline constexpr float kTooNear = -std::numeric_limits<float>::infinity();  ///< something, below the minimum
inline constexpr float kInvalid = std::numeric_limits<float>::quiet_NaN();  ///< measurement failed

/// True for a distance, false for kNoReturn, kTooNear and kInvalid.
inline bool is_hit(float range_m) { return std::isfinite(range_m); }

/// Constants of one sweep. Angles are counter-clockwise from the sensor's x axis.
struct ScanGeometry {
  float angle_min_rad = 0.0F;        ///< of beam 0
  float angle_increment_rad = 0.0F;  ///< between neighbours
  float time_increment_s = 0.0F;     ///< between neighbours: a scan is not instantaneous
  float period_s = 0.0F;             ///< from one scan's first beam to the next one's
  float range_min_m = 0.0F;
  float range_max_m = 0.0F;
  friend bool operator==(const ScanGeometry&, const ScanGeometry&) = default;
};

/// One sweep of a laser range finder. Fixed storage: a scan lives in a ring buffer's slot, and streaming
/// allocates nothing. The arrays are filled up to `beams` and not zeroed first.
struct Scan {  // NOLINT(cppcoreguidelines-pro-type-member-init)
  /// One revolution at the finest resolution (ARES) of any Hokuyo named in PROTOCOLS.
  static constexpr std::size_t kMaxBeams = 1440;

  Stamp first_beam{};  ///< when beam 0 was measured, on the host's steady clock
  Stamp arrival{};     ///< when the last byte was read; staleness is measured from it
  /// How much longer than the fastest data of its stream the scan waited on its line.
  Duration late{};
  std::uint64_t sequence = 0;  ///< number of the scan since the daemon's start; counts lost scans
  ScanGeometry geometry;
  std::uint16_t beams = 0;
  bool has_intensity = false;
  std::array<float, kMaxBeams> range_m;            ///< distance, or one of the values above
  std::array<std::uint16_t, kMaxBeams> intensity;  ///< valid when has_intensity

  [[nodiscard]] std::span<const float> ranges() const { return {range_m.data(), checked_beams()}; }
  /// `beams`, which no loop over the arrays may exceed.
  [[nodiscard]] std::size_t checked_beams() const {
    require(beams <= kMaxBeams, "types::Scan: more beams than it holds");
    return beams;
  }
  [[nodiscard]] float angle_rad(std::size_t beam) const {
    return geometry.angle_min_rad + static_cast<float>(beam) * geometry.angle_increment_rad;
  }
  /// The inverse: which beam looks at an angle, with its fraction. The sector may be turns away from
  /// (-pi, pi], and outside it the number is below 0 or beyond `beams`.
  [[nodiscard]] double beam_at(double angle_rad) const {
    return (angle_rad - static_cast<double>(geometry.angle_min_rad)) /
           static_cast<double>(geometry.angle_increment_rad);
  }
};

}  // namespace topo::types
