// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/app/operator.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <cmath>
#include <utility>

#include "daemon/app/battery_text.hpp"
#include "daemon/app/json/plan_json.hpp"
#include "daemon/app/logging.hpp"
#include "daemon/app/monitor.hpp"
#include "drivers/io/posix.hpp"

namespace topo::daemon {

using pipeline::Order;
using types::Errc;
using types::fail;
using types::Result;
using types::Status;

namespace {

/// True when the robot stands until the operator says where it is, by hand too.
bool is_held(types::PlaceStanding standing) {
  return standing == types::PlaceStanding::kProposed || standing == types::PlaceStanding::kDropped;
}

}  // namespace

Operator::Operator(const Configuration& configuration, std::string effective, HandOvers& hand_overs,
                   Monitor& monitor, Announce announce)
    : configuration_(configuration),
      effective_(std::move(effective)),
      hand_overs_(hand_overs),
      monitor_(monitor),
      announce_(std::move(announce)),
      plan_(hand_overs, [this](const pipeline::Decision& decision) { tell(decision); }),
      estop_(
          hand_overs.estop, [&monitor]() -> const pipeline::ControlReport& { return monitor.base().control; },
          configuration.control.state_folder, [this](const Json& event) { announce_(event); }),
      silence_([&monitor]() -> const pipeline::ControlReport& { return monitor.base().control; },
               configuration.control.state_folder),
      team_(configuration.team, hand_overs.team,
            [this](team::OrderKind kind, std::uint16_t from) { obey(kind, from); }),
      saver_(hand_overs),
      sessions_(configuration, hand_overs, files_) {}

Status Operator::start() {
  if (auto s = estop_.start(); !s) return s;
  if (auto s = silence_.start(); !s) return s;
  if (auto s = files_.start("files"); !s) return s;
  return searches_.start("searches");
}

void Operator::collect(std::size_t i) {
  if (i == 0) return files_.collect();
  if (i == 1) return searches_.collect();
  i == 2 ? estop_.collect() : team_.collect();
}

void Operator::tick(types::Stamp now) {
  plan_.update();
  team_.tick(now);
  add_distance();
  estop_.tick();
  silence_.tick(now);
  if (estop_.latched()) interrupt("the emergency stop");
  const auto* report = plan_.report();
  if (report != nullptr && missions_.note(*report, now)) {
    announce_mission("done");
    const std::string& folder = configuration_.exploration.save_folder;
    if (!folder.empty()) {
      save_map(folder, [](const Result<Json>& saved) {
        if (!saved) spdlog::error("the map was not saved: {}", saved.error().message);
      });
    }
  }
  if (const auto* journal = hand_overs_.journal.report.take_new(); journal != nullptr)
    sessions_.note(*journal);
  if (sessions_.tick(now, monitor_.mapping())) give_up("the robot's place was dropped");
  watch_battery(now);
  watch_readiness();
}

void Operator::add_distance() {
  const types::Vector2 at = monitor_.base().state.odometry.T_odom_base.se2().translation();
  // A jump is a reset of the base's odometry, not motion: at 10 Hz no robot moves half a metre per tick.
  constexpr double kJump_m = 0.5;
  const double way_m = (at - measured_from_).norm();
  if (measuring_ && missions_.active() && way_m < kJump_m) distance_m_ += way_m;
  measured_from_ = at;
  measuring_ = monitor_.base().ready;
}

void Operator::watch_battery(types::Stamp now) {
  const BaseReport& base = monitor_.base();
  const types::BatteryLimits limits = configuration_.exploration.battery_limits();
  const types::BaseState& state = base.state;
  const bool low = base.ready && types::is_battery_low(state.battery_v, state.state_of_charge, limits);
  if (!battery_.note(low, now)) return;
  spdlog::warn("battery low: {}; {}", battery_text(state), battery_limits_text(limits));
  announce_({{"event", "battery_low"}, {"battery_v", state.battery_v}});
}

void Operator::watch_readiness() {
  const bool ready = obstacle().empty();
  if (ready && !ready_) announce_({{"event", "ready"}});
  ready_ = ready;
}

std::string Operator::obstacle() const {
  if (std::string stopped = estop_.obstacle(); !stopped.empty()) return stopped;
  if (std::string device = monitor_.device_obstacle(); !device.empty()) return device;
  if (std::string team = team_.obstacle(); !team.empty()) return team;
  const auto* report = plan_.report();
  if (!monitor_.has_map() || report == nullptr)
    return "there is no map yet: no scan was matched since the start";
  return sessions_.obstacle();
}

Status Operator::begin(Order order, const types::Vector2& target) {
  ++commands_;
  if (auto s = missions_.begin(order, target, obstacle(), io::monotonic_now()); !s) return s;
  distance_m_ = 0.0;
  end_driving();
  send_mission();
  announce_mission("mission");
  return {};
}

Status Operator::pause() {
  ++commands_;
  if (auto s = missions_.pause("paused by the operator"); !s) return s;
  send_mission();
  announce_mission("mission");
  return {};
}

Status Operator::resume() {
  ++commands_;
  if (auto s = missions_.resume(obstacle()); !s) return s;
  end_driving();
  send_mission();
  announce_mission("mission");
  return {};
}

void Operator::obey(team::OrderKind kind, std::uint16_t from) {
  kind == team::OrderKind::kEstop ? estop() : stop();
  announce_({{"event", "team_order"}, {"order", team::to_text(kind)}, {"robot", from}});
}

std::uint64_t Operator::estop_team() {
  estop();
  return team_.order(team::OrderKind::kEstop);
}

std::uint64_t Operator::stop_team() {
  stop();
  return team_.order(team::OrderKind::kStop);
}

Json Operator::team() const { return team_.json(io::monotonic_now()); }

/// Takes control from the mission: the operator must resume it explicitly.
void Operator::interrupt(const std::string& why) {
  if (missions_.state() != MissionState::kUnderWay || !missions_.pause("paused by " + why)) return;
  send_mission();
  announce_mission("mission");
}

/// Ends the mission, which was given in a map that is void.
void Operator::give_up(const std::string& why) {
  end_driving();
  if (!missions_.fail(why, io::monotonic_now())) return;
  send_mission();
  announce_mission("done");
}

void Operator::send_mission() {
  hand_overs_.to_planning.mission.store(missions_.mission());
  hand_overs_.to_planning.wakeup.post();
}

void Operator::end_driving() { hand_overs_.drive.store({io::monotonic_now() - std::chrono::hours(1), {}}); }

void Operator::tell(const pipeline::Decision& decision) {
  spdlog::info("goal ({:.2f}, {:.2f}): {}", decision.p_map.x(), decision.p_map.y(), decision.text);
  announce_({{"event", "decision"},
             {"x_m", decision.p_map.x()},
             {"y_m", decision.p_map.y()},
             {"text", decision.text}});
}

void Operator::announce_mission(std::string_view event) {
  spdlog::info("mission {} ({}): {}{}{}", missions_.number(), to_text(missions_.order()),
               to_text(missions_.state()), missions_.reason().empty() ? "" : ": ", missions_.reason());
  announce_({{"event", event}, {"mission", mission_json()}});
}

void Operator::estop() {
  ++commands_;
  estop_.press();
  interrupt("the emergency stop");
}

void Operator::clear_estop(std::function<void(Status)> done) {
  end_driving();  // requests from before the e-stop are void
  estop_.clear(std::move(done));
}

Status Operator::drive(const types::Twist2& twist) {
  const BaseConfig& base = configuration_.base;
  if (std::abs(twist.v_mps) > base.v_max_mps) {
    return fail(Errc::kInvalidInput,
                fmt::format("v_mps: found {}, expected at most {} either way", twist.v_mps, base.v_max_mps));
  }
  if (std::abs(twist.omega_radps) > base.omega_max_radps) {
    return fail(Errc::kInvalidInput, fmt::format("omega_radps: found {}, expected at most {} either way",
                                                 twist.omega_radps, base.omega_max_radps));
  }
  if (const std::string absent = monitor_.base_obstacle(); !absent.empty()) return fail(Errc::kBusy, absent);
  // The base's report follows a clear with delay; the gate decides in any case.
  if (estop_.pressed()) return fail(Errc::kBusy, estop_.obstacle());
  if (is_held(sessions_.standing())) return fail(Errc::kBusy, sessions_.obstacle());
  ++commands_;
  interrupt("an operator who drives");  // or the robot would resume when the keys are released
  hand_overs_.drive.store({io::monotonic_now(), twist});
  return {};
}

void Operator::stop() {
  ++commands_;
  end_driving();
  if (!missions_.stop(io::monotonic_now())) return;
  send_mission();
  announce_mission("done");
}

void Operator::go_to(const types::Vector2& target, std::function<void(Status)> done) {
  if (const std::string why = obstacle(); !why.empty()) return done(fail(Errc::kBusy, why));
  const auto* report = plan_.report();
  if (report == nullptr || report->analysis == nullptr)
    return done(fail(Errc::kBusy, "the map was not analysed yet; try again in a moment"));
  // The duration of the search grows with the map; an e-stop must not wait for it.
  auto job = [this, analysis = report->analysis, params = planner_params(configuration_), target, done,
              from = report->T_map_base.se2().translation(), number = ++commands_]() -> Background::Finish {
    const Status possible = pipeline::check_target(*analysis, params, from, target);
    return [this, possible, target, done, number] {
      if (!possible) return done(possible);
      // After a stop in the meantime the robot must not start to drive.
      if (commands_ != number) return done(fail(Errc::kBusy, "another command came meanwhile; say it again"));
      done(begin(Order::kGoTo, target));
    };
  };
  if (const auto added = searches_.add(std::move(job)); !added) done(added);
}

void Operator::save_map(const std::string& folder, std::function<void(Result<Json>)> done) {
  if (folder.empty() || folder.front() != '/') {
    return done(
        fail(Errc::kInvalidInput, fmt::format("dir: found \"{}\", expected an absolute path", folder)));
  }
  auto job = [this, folder, done]() -> Background::Finish {
    return [done, saved = saver_.save(folder)] {
      if (!saved) return done(tl::unexpected(saved.error()));
      spdlog::info("map revision {} saved to {}", saved->revision, saved->folder);
      done(Json{{"dir", saved->folder},
                {"revision", saved->revision},
                {"width", saved->width},
                {"height", saved->height},
                {"points", saved->points},
                {"places", saved->places},
                {"goals", saved->goals}});
    };
  };
  if (const auto added = files_.add(std::move(job)); !added) done(tl::unexpected(added.error()));
}

void Operator::load_session(const std::string& name, const std::optional<types::Se2>& pose,
                            SessionDone done) {
  if (missions_.active()) return done(fail(Errc::kBusy, "a mission is under way; topoctl stop ends it"));
  sessions_.load(name, pose, done);
}

void Operator::confirm_session(const std::optional<types::Se2>& pose, SessionDone done) {
  if (missions_.active()) return done(fail(Errc::kBusy, "a mission is under way; topoctl stop ends it"));
  sessions_.confirm(pose, done);
}

Status Operator::begin_anew() { return sessions_.begin_anew(); }

Status Operator::set_log_level(const std::string& level) {
  const auto parsed = parse_log_level(level);
  if (!parsed) {
    return fail(Errc::kInvalidInput,
                fmt::format("level: found \"{}\", expected trace, debug, info, warning or error", level));
  }
  topo::daemon::set_log_level(*parsed);
  return {};
}

}  // namespace topo::daemon
