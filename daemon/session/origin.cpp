// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/session/origin.hpp"

#include <cstdint>
#include <memory>
#include <random>
#include <utility>

namespace topo::daemon {

slam::Origin new_maker(int robot) {
  std::random_device system;
  // Without 0, which is the run of sessions from before runs were distinguished.
  std::uniform_int_distribution<std::uint32_t> any(1);
  return {static_cast<std::uint16_t>(robot), any(system)};
}

slam::Session claimed(slam::Session session, int robot) {
  for (slam::KeyframePtr& keyframe : session.keyframes) {
    if (keyframe->id.robot != 0) continue;
    slam::Keyframe own = *keyframe;
    own.id.robot = static_cast<std::uint16_t>(robot);
    keyframe = std::make_shared<const slam::Keyframe>(std::move(own));
  }
  return session;
}

}  // namespace topo::daemon
