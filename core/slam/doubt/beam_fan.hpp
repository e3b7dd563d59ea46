// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/slam/keyframe.hpp"

namespace topo::slam {

/// A piece of surface that somebody hit.
struct SurfacePoint {
  types::Vector2 position;
  types::Vector2 normal;  ///< of length 1, towards who hit it
};

/// The surface at one of a keyframe's hits, in its base_link. `surfels`, `sensor`: those of the keyframe.
/// Where no surfel is near, the surface faces the laser.
SurfacePoint surface_at(std::span<const Surfel> surfels, const Point& sensor, const Point& hit);

/// The beams of one keyframe where the map has it, found by their direction.
class BeamFan {
 public:
  BeamFan(const Keyframe& keyframe, const types::Se2& T_map_base);

  /// Did this keyframe look at the surface and not see it there? One of its beams, from the surface's side
  /// and past the point within 0.05 m, then ended more than the tolerance behind the surface, or more than
  /// the tolerance before it and at most 0.5 m short of the point. Stopped earlier it says nothing of what is
  /// behind; along a wall it ends far from the point and yet on the surface.
  [[nodiscard]] bool contradicts(const SurfacePoint& surface, double tolerance_m) const;

 private:
  struct Beam {
    double bearing_rad;  ///< from first_rad_ on, counter-clockwise
    types::Vector2 end;
  };
  types::Vector2 laser_;
  double first_rad_ = 0.0;  ///< between the last beam and the first
  double reach_m_ = 0.0;
  std::vector<Beam> beams_;  ///< by bearing
};

}  // namespace topo::slam
