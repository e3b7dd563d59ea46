// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include "daemon/app/area_control.hpp"
#include "daemon/app/background.hpp"
#include "daemon/app/battery_watch.hpp"
#include "daemon/app/doubt_watch.hpp"
#include "daemon/app/estop_control.hpp"
#include "daemon/app/map_saver.hpp"
#include "daemon/app/map_view.hpp"
#include "daemon/app/mission_control.hpp"
#include "daemon/app/mission_way.hpp"
#include "daemon/app/plan_watch.hpp"
#include "daemon/app/session_control.hpp"
#include "daemon/app/silence_control.hpp"
#include "daemon/app/team_control.hpp"
#include "daemon/control/methods.hpp"

namespace topo::daemon {

class Monitor;

/// What subscribers were told last.
struct Told {
  BatteryWatch battery;
  bool ready = false;
};

/// Executes the operator's requests. Main only, except for the jobs that it gives to the background threads.
class Operator final : public Operations {
 public:
  using Announce = std::function<void(const Json& event)>;
  /// `effective`: the configuration as text. `announce` receives events for subscribers.
  Operator(const Configuration& configuration, std::string effective, HandOvers& hand_overs, Monitor& monitor,
           Announce announce);

  /// Latches the e-stop when it was latched at the daemon's last end, and starts the background threads. To
  /// be called before the base's thread is started.
  types::Status start();
  /// Main only: when finished_fds()[i] is readable, call collect(i).
  [[nodiscard]] std::array<int, 4> finished_fds() const {
    return {files_.fd(), searches_.fd(), estop_.fd(), team_.fd()};
  }
  void collect(std::size_t i);

  /// To be called every tick, after the monitor's update: handles planning's report, the e-stop, the journal
  /// and the battery.
  void tick(types::Stamp now);

  [[nodiscard]] Json status() const override;
  [[nodiscard]] Json health() const override;
  [[nodiscard]] Json latency() const override;
  [[nodiscard]] Json config() const override { return Json{{"text", effective_}}; }
  [[nodiscard]] Json goals() const override;
  [[nodiscard]] Json places() const override;
  [[nodiscard]] Json progress() const override;
  [[nodiscard]] Json scan() const override;
  void map_tiles(std::uint64_t since, std::function<void(types::Result<Json>)> done) override;
  void map_trails(std::function<void(types::Result<Json>)> done) override;
  void session_tiles(std::uint64_t since, SessionDone done) override;
  void doctor(std::function<void(Json)> done) override;
  void estop() override;
  std::uint64_t estop_team() override;
  types::Result<Json> order_team(team::OrderKind kind, std::optional<std::uint16_t> to) override;
  [[nodiscard]] Json team() const override;
  void clear_estop(std::function<void(types::Status)> done) override;
  types::Status drive(const types::Twist2& twist) override;
  void stop() override;
  types::Status explore() override { return begin(pipeline::Order::kExplore, {0.0, 0.0}); }
  types::Status go_home() override { return begin(pipeline::Order::kHome, {0.0, 0.0}); }
  types::Status pause() override;
  types::Status resume() override;
  void go_to(const types::Vector2& target, std::function<void(types::Status)> done) override;
  void save_map(const std::string& folder, std::function<void(types::Result<Json>)> done) override;
  void list_sessions(SessionDone done) override { sessions_.list(done); }
  void save_session(const std::string& name, SessionDone done) override { sessions_.save(name, done); }
  void load_session(const std::string& name, const std::optional<types::Se2>& pose,
                    SessionDone done) override;
  void confirm_session(const std::optional<types::Se2>& pose, SessionDone done) override;
  types::Status begin_anew() override;
  types::Status set_log_level(const std::string& level) override;
  [[nodiscard]] Json map_doubt() const override { return doubts_.whole_json(); }
  [[nodiscard]] Json areas() const override { return areas_.json(); }
  types::Result<std::string> draw_area(const types::Polygon& corners_map, types::AreaKind kind) override {
    return areas_.draw(corners_map, kind);
  }
  types::Status withdraw_area(const std::string& id) override { return areas_.withdraw(id); }

 private:
  types::Status begin(pipeline::Order order, const types::Vector2& target);
  /// Why the robot cannot start now; empty when it can.
  [[nodiscard]] std::string obstacle() const;
  [[nodiscard]] Json mission_json() const;
  void interrupt(const std::string& why);
  types::Status obey(team::OrderKind kind, std::uint16_t from);
  void give_up(const std::string& why);
  void send_mission();
  void end_driving();
  void announce_mission(std::string_view event);
  void tell(const pipeline::Decision& decision);
  void watch_battery(types::Stamp now);
  void watch_readiness();

  const Configuration& configuration_;
  std::string effective_;
  HandOvers& hand_overs_;
  Monitor& monitor_;
  Announce announce_;
  PlanWatch plan_;
  MissionControl missions_;
  std::uint64_t commands_ = 0;  ///< that move or stop the robot; a slow one must not override a later one
  EStopControl estop_;
  SilenceControl silence_;
  TeamControl team_;
  MapSaver saver_;
  MapView view_;             ///< used by the thread of searches
  AreaControl areas_;        // the same
  SessionControl sessions_;  // declared before the thread of its jobs, which is destroyed first
  DoubtWatch doubts_;        // the same
  Background files_, searches_;
  Told told_;
  MissionWay way_;
};

}  // namespace topo::daemon
