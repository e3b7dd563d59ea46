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
            [this](team::OrderKind kind, std::uint16_t from) { return obey(kind, from); }),
      saver_(hand_overs),
      view_(hand_overs, configuration.mapping.grid),
      areas_(configuration.area, hand_overs, files_, configuration.control.state_folder,
             [this](const Json& event) { announce_(event); }),
      sessions_(configuration, hand_overs, files_),
      doubts_(hand_overs,
              MapDoubter(hand_overs, sessions_.client(), static_cast<std::uint16_t>(configuration.robot.id),
                         mapper_params(configuration).graph),
              files_) {}

Status Operator::start() {
  areas_.start();
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
  areas_.note(team_.areas());
  if (const auto keyframes = view_.newer_keyframes()) areas_.note_map(*keyframes);
  const BaseReport& base = monitor_.base();
  way_.note(base.state.odometry.T_odom_base.se2().translation(), base.ready, missions_.active());
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
  doubts_.tick(now, monitor_.mapping());
  watch_battery(now);
  watch_readiness();
}

void Operator::watch_battery(types::Stamp now) {
  const BaseReport& base = monitor_.base();
  const types::BatteryLimits limits = configuration_.exploration.battery_limits();
  const types::BaseState& state = base.state;
  const bool low = base.ready && types::is_battery_low(state.battery_v, state.state_of_charge, limits);
  if (!told_.battery.note(low, now)) return;
  spdlog::warn("battery low: {}; {}", battery_text(state), battery_limits_text(limits));
  announce_({{"event", "battery_low"}, {"battery_v", state.battery_v}});
}

void Operator::watch_readiness() {
  const bool ready = obstacle().empty();
  if (ready && !told_.ready) announce_({{"event", "ready"}});
  told_.ready = ready;
}

std::string Operator::obstacle() const {
  if (std::string stopped = estop_.obstacle(); !stopped.empty()) return stopped;
  if (std::string device = monitor_.device_obstacle(); !device.empty()) return device;
  if (std::string team = team_.obstacle(); !team.empty()) return team;
  if (!areas_.obstacle().empty()) return areas_.obstacle();
  const auto* report = plan_.report();
  if (!monitor_.has_map() || report == nullptr)
    return "there is no map yet: no scan was matched since the start";
  return sessions_.obstacle();
}

Status Operator::begin(Order order, const types::Vector2& target) {
  ++commands_;
  if (auto s = missions_.begin(order, target, obstacle(), io::monotonic_now()); !s) return s;
  way_.begin();
  end_driving();
  send_mission();
  announce_mission("mission");
  return {};
}

Status Operator::pause() {
  ++commands_;
  team_.note_halt(io::monotonic_now());
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

Status Operator::obey(team::OrderKind kind, std::uint16_t from) {
  Status done = carry_out(*this, kind);
  Json event{{"event", "team_order"}, {"order", team::to_text(kind)}, {"robot", from}};
  if (!done) event["refused"] = done.error().message;
  announce_(event);
  return done;
}

std::uint64_t Operator::estop_team() {
  estop();
  return team_.order(team::OrderKind::kEstop);
}

Result<Json> Operator::order_team(team::OrderKind kind, std::optional<std::uint16_t> to) {
  if (to && team_.is_this(*to)) {
    if (const Status done = carry_out(*this, kind); !done) return tl::unexpected(done.error());
    return Json::object();
  }
  if (to) {
    const auto sent = team_.order_one(kind, *to, io::monotonic_now());
    if (!sent) return tl::unexpected(sent.error());
    return Json{{"order", *sent}};
  }
  const Status here = carry_out(*this, kind);  // whatever it says, the mates are told
  Json answer{{"order", team_.order(kind)}};
  if (!here) answer["refused_here"] = here.error().message;
  return answer;
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
  team_.note_halt(io::monotonic_now());
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
  team_.note_halt(io::monotonic_now());
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
  pipeline::PlannerParams params = planner_params(configuration_);
  params.area = areas_.in_force();
  pipeline::TargetGround ground{report->analysis, report->area, report->T_map_base.se2().translation()};
  auto job = [this, ground = std::move(ground), params = std::move(params), target, done,
              number = ++commands_]() -> Background::Finish {
    const Status possible = pipeline::check_target(ground, params, target);
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
  auto job = [this, folder, done, scans = scan_count(monitor_.mapping())]() -> Background::Finish {
    const auto doubt = doubts_.doubter().find(scans);
    return [done, saved = saver_.save(folder, doubt ? &*doubt : nullptr)] {
      if (!saved) return done(tl::unexpected(saved.error()));
      spdlog::info("map revision {} saved to {}", saved->revision, saved->folder);
      if (!saved->doubted.empty()) spdlog::warn("{}", saved->doubted);
      done(Json{{"dir", saved->folder},
                {"revision", saved->revision},
                {"width", saved->width},
                {"height", saved->height},
                {"points", saved->points},
                {"places", saved->places},
                {"goals", saved->goals},
                {"doubted", saved->doubted}});
    };
  };
  if (const auto added = files_.add(std::move(job)); !added) done(tl::unexpected(added.error()));
}

void Operator::map_tiles(std::uint64_t since, std::function<void(Result<Json>)> done) {
  auto job = [this, since, done]() -> Background::Finish {
    return [done, tiles = view_.tiles(since)] { done(tiles); };
  };
  if (const auto added = searches_.add(std::move(job)); !added) done(tl::unexpected(added.error()));
}

void Operator::map_trails(std::function<void(Result<Json>)> done) {
  auto job = [this, done]() -> Background::Finish {
    return [done, trails = view_.trails()] { done(trails); };
  };
  if (const auto added = searches_.add(std::move(job)); !added) done(tl::unexpected(added.error()));
}

void Operator::session_tiles(std::uint64_t since, SessionDone done) {
  const std::optional<PlaceOffer> offer = sessions_.waiting();
  if (!offer) return done(fail(Errc::kNotFound, "no session waits for the robot's place"));
  auto job = [this, path = offer->path, since, done]() -> Background::Finish {
    return [done, tiles = view_.of_session().tiles(path, since)] { done(tiles); };
  };
  if (const auto added = searches_.add(std::move(job)); !added) done(tl::unexpected(added.error()));
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
