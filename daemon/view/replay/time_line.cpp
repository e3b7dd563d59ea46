// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/view/replay/time_line.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace topo::daemon {

using types::Errc;
using types::fail;

void TimeLine::set_length(double length_s) {
  length_s_ = length_s;
  position_s_ = std::min(position_s_, length_s);
}

void TimeLine::advance(double seconds) {
  if (playing_) position_s_ = std::min(length_s_, position_s_ + speed_ * seconds);
}

types::Status TimeLine::take(const Json& wish) {
  TimeLine next = *this;
  if (wish.contains("position_s")) {
    const Json& position = wish["position_s"];
    if (!position.is_number())
      return fail(Errc::kInvalidInput,
                  fmt::format("position_s: found {}, expected a number of seconds", position.dump()));
    next.position_s_ = std::clamp(position.get<double>(), 0.0, length_s_);
  }
  if (wish.contains("speed")) {
    const auto speed = real_param(wish, "speed");
    if (!speed) return fail(Errc::kInvalidInput, speed.error().message);
    if (*speed < kSlowest || *speed > kFastest) {
      return fail(Errc::kInvalidInput,
                  fmt::format("speed: found {}, expected {} to {} times", *speed, kSlowest, kFastest));
    }
    next.speed_ = *speed;
  }
  if (wish.contains("playing")) {
    const auto playing = switch_param(wish, "playing");
    if (!playing) return fail(Errc::kInvalidInput, playing.error().message);
    next.playing_ = *playing;
    if (*playing && !wish.contains("position_s") && position_s_ >= length_s_) next.position_s_ = 0.0;
  }
  *this = next;
  return {};
}

Json TimeLine::json() const {
  return {{"position_s", position_s_}, {"length_s", length_s_}, {"speed", speed_}, {"playing", playing_}};
}

}  // namespace topo::daemon
