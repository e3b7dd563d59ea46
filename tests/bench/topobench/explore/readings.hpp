// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/types/base_state.hpp"
#include "core/types/scan.hpp"
#include "core/types/se2.hpp"

namespace topo::bench {

/// Fidelity "plan" has no mapper: this stands in for what it would have said of the front scan of this stamp.
struct PoseReading {
  types::Stamp stamp{};
  types::Se2 T_map_base;
};

/// Everything that the drivers hand over in one tick, oldest first: all that the robot ever knows.
struct Readings {
  std::vector<types::BaseState> states;
  std::vector<types::Scan> front;
  std::vector<types::Scan> coronal;
  std::vector<PoseReading> poses;  ///< fidelity "plan" only

  void clear() {
    states.clear();
    front.clear();
    coronal.clear();
    poses.clear();
  }
};

}  // namespace topo::bench
