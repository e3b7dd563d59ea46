// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/slam/keyframe.hpp"
#include "core/slam/session.hpp"

namespace topo::daemon {

/// Who makes the keyframes of a map from now on: the robot, and a run that no map before had, be it of this
/// start of the daemon or of another one. Asks the system for a random number: a robot's clock may stand
/// where it stood before. `robot`: 1 to 250, as robot.id.
[[nodiscard]] slam::Origin new_maker(int robot);

/// The session with the robot as the origin of what no robot has signed: daemons once wrote 0 for every
/// robot, and its keyframes would be taken for a mate's.
[[nodiscard]] slam::Session claimed(slam::Session session, int robot);

}  // namespace topo::daemon
