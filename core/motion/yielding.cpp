// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/motion/yielding.hpp"

namespace topo::motion {
namespace {

constexpr types::Duration kPatience = std::chrono::seconds(10);
constexpr types::Duration kForgotten = std::chrono::seconds(3);  // not held up for this long: a new encounter
constexpr types::Duration kGoFirst = std::chrono::milliseconds(1500);

}  // namespace

void Yielding::update(types::Stamp now, bool held_up, std::span<const perception::MovingObstacle> moving) {
  if (held_up) {
    if (last_ == types::Stamp{} || now - last_ > kForgotten) since_ = now;
    last_ = now;
    if (!moving.empty()) on_the_right_ = moving.front().centre.y() < 0.0;
  }
  const bool patient = last_ != types::Stamp{} && now - since_ <= kPatience;
  waits_ = held_up && patient;
  lets_go_first_ = !held_up && patient && on_the_right_ && now - last_ <= kGoFirst;
}

}  // namespace topo::motion
