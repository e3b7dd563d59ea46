// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "tests/sim/raster.hpp"

namespace topo::bench::bound {

using Way = std::vector<sim::Vector2>;
double length_m(const Way& way);

/// Distances along the places that a robot's disc gets to, in cells of 0.1 m with moves in 16 directions: at
/// most kLonger times the shortest way.
class WayMap {
 public:
  static constexpr double kLonger = 1.028;
  using Field = std::vector<float>;  ///< metres, by cell; infinite: not reached

  /// `poses`: sim::reachable_poses.
  explicit WayMap(const sim::Raster& poses);

  [[nodiscard]] const sim::Raster& places() const { return places_; }
  /// Distances to the nearest of several places.
  [[nodiscard]] Field field_to(std::span<const sim::Vector2> places) const;
  [[nodiscard]] double distance_m(const Field& field, const sim::Vector2& from) const;
  /// The way down a field, its corners cut where the straight way is free. Empty: none.
  [[nodiscard]] Way way(const Field& field, const sim::Vector2& from) const;

 private:
  [[nodiscard]] int cell_of(const sim::Vector2& p) const;
  [[nodiscard]] bool is_straight(const sim::Vector2& a, const sim::Vector2& b) const;

  sim::Raster places_;
};

}  // namespace topo::bench::bound
