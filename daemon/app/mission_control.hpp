// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/pipeline/planning_step.hpp"

namespace topo::daemon {

/// What became of the newest mission.
enum class MissionState { kNone, kUnderWay, kPaused, kDone, kFailed, kStopped };
/// One word for tables and JSON.
std::string_view to_text(MissionState state);
std::string_view to_text(pipeline::Order order);

/// The missions that operators give, one after the other. A value without threads or clock; main keeps one
/// and hands mission() to planning after every change. After the start of the daemon the order is to stand.
class MissionControl {
 public:
  /// A new mission. `obstacle`: why the robot cannot be sent off now, empty when it can. Refused (kBusy)
  /// then, and when an exploration shall begin while one is under way.
  types::Status begin(pipeline::Order order, const types::Vector2& target, const std::string& obstacle,
                      types::Stamp now);
  /// The robot stands, the mission is kept. Refused when none is under way.
  types::Status pause(std::string why);
  /// Refused when there is an obstacle or nothing to go on with.
  types::Status resume(const std::string& obstacle);
  /// Ends the mission, if there is one. True when there was one.
  bool stop(types::Stamp now);

  /// Planning's newest word. True when it ends the mission.
  bool note(const pipeline::PlanningReport& report, types::Stamp now);

  [[nodiscard]] const pipeline::Mission& mission() const { return mission_; }
  [[nodiscard]] MissionState state() const { return state_; }
  [[nodiscard]] pipeline::Order order() const { return order_; }  ///< of the newest mission, ended or not
  [[nodiscard]] std::uint64_t number() const { return number_; }  ///< 0: none yet
  [[nodiscard]] const std::string& reason() const { return reason_; }  ///< of a pause or an end
  [[nodiscard]] bool active() const {
    return state_ == MissionState::kUnderWay || state_ == MissionState::kPaused;
  }
  /// From the beginning of the newest mission to its end or now.
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
