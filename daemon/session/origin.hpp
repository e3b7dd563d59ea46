// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/slam/keyframe.hpp"
#include "core/slam/session.hpp"

namespace topo::daemon {

/// Origin of a map's new keyframes: the robot, and a run number that no earlier map has, of this or another
/// start of the daemon. The run is a random number from the system, because a robot's clock may repeat times.
/// `robot`: 1 to 250, as robot.id.
[[nodiscard]] slam::Origin new_maker(int robot);

/// The session with the robot as the origin of all keyframes with robot number 0, which earlier daemons wrote
/// for every robot; they would otherwise be taken for a team-mate's.
[[nodiscard]] slam::Session claimed(slam::Session session, int robot);

}  // namespace topo::daemon
