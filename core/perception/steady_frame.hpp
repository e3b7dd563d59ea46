// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "core/perception/params.hpp"
#include "core/types/base_state.hpp"
#include "core/types/se2.hpp"
#include "core/types/transform.hpp"

namespace topo::perception {

/// Dead reckoning without its drift. After one round of turning in a dead end, the odometry is off by 0.3
/// rad, and the remembered surroundings with it. The mapper's drift corrections are followed as far as the
/// motion since the last one explains them. A correction that bends the map (a loop closure) or slides it
/// under a standing robot is not followed.
class SteadyFrame {
 public:
  explicit SteadyFrame(const SteadyFrameParams& params = {}) : params_(params) {}
  /// `T_map_odom`: current pose of odom in map. `bends`: how often the map was bent. `odometry` is of about
  /// the same time.
  void update(const types::Transform2<types::Map, types::Odom>& T_map_odom, std::uint32_t bends,
              const types::Odometry& odometry);
  /// The map pose is unknown: odometry is used uncorrected until it is known again.
  void lose() { T_map_odom_.reset(); }
  /// The same odometry in the steady frame, which takes the place of odom.
  [[nodiscard]] types::Odometry steady(const types::Odometry& odometry) const;

 private:
  SteadyFrameParams params_;
  types::Se2 T_steady_odom_;
  std::optional<types::Se2> T_map_odom_;
  types::Se2 T_odom_base_;  ///< at the last update
  std::uint32_t bends_ = 0;
};

}  // namespace topo::perception
