// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/motion/yielding.hpp"

namespace topo::motion {

void Yielding::update(types::Stamp now, bool held_up, std::span<const perception::MovingObstacle> moving) {
  if (held_up) {
    if (last_ == types::Stamp{} || now - last_ > params_.forgotten) since_ = now;
    last_ = now;
    if (!moving.empty()) on_the_right_ = moving.front().centre.y() < 0.0;
  }
  const bool patient = last_ != types::Stamp{} && now - since_ <= params_.patience;
  waits_ = held_up && patient;
  lets_go_first_ = !held_up && patient && on_the_right_ && now - last_ <= params_.go_first;
}

}  // namespace topo::motion
