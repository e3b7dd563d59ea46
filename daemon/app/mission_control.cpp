// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/app/mission_control.hpp"

#include <fmt/format.h>

#include <utility>

namespace topo::daemon {

using pipeline::Order;
using types::Errc;
using types::Status;

std::string_view to_text(MissionState state) {
  switch (state) {
    case MissionState::kNone:
      return "none";
    case MissionState::kUnderWay:
      return "under way";
    case MissionState::kPaused:
      return "paused";
    case MissionState::kDone:
      return "done";
    case MissionState::kFailed:
      return "failed";
    case MissionState::kStopped:
      return "stopped";
  }
  return "unknown";
}

std::string_view to_text(Order order) {
  switch (order) {
    case Order::kStand:
      return "stand";
    case Order::kExplore:
      return "explore";
    case Order::kHome:
      return "home";
    case Order::kGoTo:
      return "goto";
  }
  return "unknown";
}

Status MissionControl::begin(Order order, const types::Vector2& target, const std::string& obstacle,
                             types::Stamp now) {
  if (!obstacle.empty()) return types::fail(Errc::kBusy, obstacle);
  if (order == Order::kExplore && order_ == Order::kExplore && active()) {
    const bool paused = state_ == MissionState::kPaused;
    return types::fail(Errc::kBusy, fmt::format("an exploration is {} already; {} ends it, then start anew{}",
                                                paused ? "paused" : "under way", "topoctl stop",
                                                paused ? ", or go on with topoctl resume" : ""));
  }
  mission_ = {mission_.number + 1, order, false, target};
  number_ = mission_.number;
  order_ = order;
  state_ = MissionState::kUnderWay;
  reason_.clear();
  begun_ = now;
  return {};
}

Status MissionControl::pause(std::string why) {
  if (state_ == MissionState::kPaused) return {};
  if (state_ != MissionState::kUnderWay)
    return types::fail(Errc::kBusy, "there is no mission under way to pause");
  mission_.paused = true;
  state_ = MissionState::kPaused;
  reason_ = std::move(why);
  return {};
}

Status MissionControl::resume(const std::string& obstacle) {
  if (state_ == MissionState::kUnderWay) return {};
  if (state_ != MissionState::kPaused)
    return types::fail(Errc::kBusy, "there is no paused mission to go on with");
  if (!obstacle.empty()) return types::fail(Errc::kBusy, obstacle);
  mission_.paused = false;
  state_ = MissionState::kUnderWay;
  reason_.clear();
  return {};
}

bool MissionControl::stop(types::Stamp now) {
  if (!active()) return false;
  end(MissionState::kStopped, "stopped by the operator", now);
  mission_ = {mission_.number + 1, Order::kStand, false, {0.0, 0.0}};
  return true;
}

bool MissionControl::fail(std::string why, types::Stamp now) {
  if (!active()) return false;
  end(MissionState::kFailed, std::move(why), now);
  mission_ = {mission_.number + 1, Order::kStand, false, {0.0, 0.0}};
  return true;
}

bool MissionControl::note(const pipeline::PlanningReport& report, types::Stamp now) {
  if (!active() || report.mission != number_ || !report.mission_ended) return false;
  const bool failed = report.activity == pipeline::Activity::kFailed;
  end(failed ? MissionState::kFailed : MissionState::kDone, report.reason, now);
  return true;
}

types::Duration MissionControl::elapsed(types::Stamp now) const {
  if (number_ == 0) return types::Duration::zero();
  return (active() ? now : ended_) - begun_;
}

void MissionControl::end(MissionState state, std::string reason, types::Stamp now) {
  state_ = state;
  reason_ = std::move(reason);
  ended_ = now;
}

}  // namespace topo::daemon
