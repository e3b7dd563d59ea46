// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "core/types/base_state.hpp"
#include "core/types/se2.hpp"
#include "core/types/transform.hpp"

namespace topo::perception {

/// Dead reckoning without its drift. A robot that turns about in a dead end has its odometry 0.3 rad off
/// after one round, and what it remembers of its surroundings with it. What the mapper says of the drift, bit
/// by bit, is followed, as far as what was driven since accounts for it; a correction that bends the map (a
/// loop closure), or slides it under a robot that stands, is not.
class SteadyFrame {
 public:
  /// Where the map has the reckoning's origin now, and how often it was bent. `odometry` is of about the same
  /// time.
  void update(const types::Transform2<types::Map, types::Odom>& T_map_odom, std::uint32_t bends,
              const types::Odometry& odometry);
  /// The map does not know: until it does again the reckoning is believed.
  void lose() { T_map_odom_.reset(); }
  /// The same motion in the steady frame, which takes the place of odom.
  [[nodiscard]] types::Odometry steady(const types::Odometry& odometry) const;

 private:
  types::Se2 T_steady_odom_;
  std::optional<types::Se2> T_map_odom_;
  types::Se2 T_odom_base_;  ///< at the last update
  std::uint32_t bends_ = 0;
};

}  // namespace topo::perception
