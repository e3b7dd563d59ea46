// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/pipeline/planning_step.hpp"

namespace topo::daemon {

/// State of the newest mission.
enum class MissionState { kNone, kUnderWay, kPaused, kDone, kFailed, kStopped };
/// One word for tables and JSON.
std::string_view to_text(MissionState state);
std::string_view to_text(pipeline::Order order);

/// The missions given by operators, one after the other. A value without threads or clock; main keeps one and
/// passes mission() to planning after every change. After the start of the daemon the order is kStand.
class MissionControl {
 public:
  /// Begins a new mission. `obstacle`: why the robot cannot start now, empty when it can. kBusy when there is
  /// an obstacle, or when an exploration is to begin during another one.
  types::Status begin(pipeline::Order order, const types::Vector2& target, const std::string& obstacle,
                      types::Stamp now);
  /// The robot stands, the mission is kept. Refused when none is under way.
  types::Status pause(std::string why);
  /// Refused when there is an obstacle or no paused mission.
  types::Status resume(const std::string& obstacle);
  /// Ends the current mission, if any. True when there was one.
  bool stop(types::Stamp now);

  /// Ends the current mission, if any, because its map is void. True when there was one.
  bool fail(std::string why, types::Stamp now);

  /// Takes planning's newest report. True when it ends the mission.
  bool note(const pipeline::PlanningReport& report, types::Stamp now);

  [[nodiscard]] const pipeline::Mission& mission() const { return mission_; }
  [[nodiscard]] MissionState state() const { return state_; }
  [[nodiscard]] pipeline::Order order() const { return order_; }  ///< of the newest mission, ended or not
  [[nodiscard]] std::uint64_t number() const { return number_; }  ///< 0: none yet
  [[nodiscard]] const std::string& reason() const { return reason_; }  ///< of a pause or an end
  [[nodiscard]] bool active() const {
    return state_ == MissionState::kUnderWay || state_ == MissionState::kPaused;
  }
  /// Time from the beginning of the newest mission to its end or to now.
  [[nodiscard]] types::Duration elapsed(types::Stamp now) const;

 private:
  void end(MissionState state, std::string reason, types::Stamp now);

  pipeline::Mission mission_;
  MissionState state_ = MissionState::kNone;
  pipeline::Order order_ = pipeline::Order::kStand;
  std::uint64_t number_ = 0;
  std::string reason_;
  types::Stamp begun_{};
  types::Stamp ended_{};
};

}  // namespace topo::daemon
