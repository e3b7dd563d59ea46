// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/integration/wire_rig.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <filesystem>

#include "daemon/app/device_connectors.hpp"
#include "daemon/config/load.hpp"
#include "drivers/io/posix.hpp"
#include "tests/sim/devices/commands.hpp"
#include "tests/unit/sim/rooms.hpp"

namespace topo::test {
namespace {

using namespace std::chrono_literals;
using sim::DeviceId;

constexpr double kEnd_x_m = 30.0, kMiddle_y_m = 4.0;  // the hall begins at x = 0

types::Duration from_s(double seconds) { return types::from_seconds(seconds); }

}  // namespace

MachineWatch::MachineWatch()
    : thread_([this] {
        constexpr types::Duration kNap = 5ms;
        while (!stop_) {
          const types::Stamp due = io::monotonic_now() + kNap;
          std::this_thread::sleep_for(kNap);  // what is measured
          const std::int64_t late_ns = (io::monotonic_now() - due).count();
          if (late_ns > latest_ns_) latest_ns_ = late_ns;
        }
      }) {}

MachineWatch::~MachineWatch() {
  stop_ = true;
  thread_.join();
}

std::unique_ptr<WireRig> WireRig::start(const WireSetup& setup) {
  daemon::block_signals();
  std::unique_ptr<WireRig> rig(new WireRig);
  rig->setup_ = setup;
  if (setup.journal) std::filesystem::create_directories(rig->sessions());
  std::filesystem::create_directories(rig->state_folder());
  if (!rig->start_simulator(setup)) return nullptr;
  rig->map_begins_here();
  if (!rig->start_daemon()) return nullptr;
  return rig;
}

bool WireRig::start_simulator(const WireSetup& setup) {
  auto world = sim::World::from_scene_text(sim::hall_text(), "hall.toml");
  if (!world) return ADD_FAILURE() << world.error().message, false;
  sim::RigConfig config;
  config.robots.push_back(setup.wires == Wires::kTcp ? sim::tcp_robot() : sim::pty_robot(folder_.str()));
  config.robots[0].watchdog_ms = setup.watchdog_ms;
  config.seed = setup.seed;
  if (setup.slow) config.robots[0].coronal = sim::ScipModel::kUrg04Lx;
  auto started = sim::SimHarness::start(std::move(*world), config);
  if (!started) return ADD_FAILURE() << started.error().message, false;
  simulator_ = std::move(*started);
  return true;
}

std::string WireRig::configuration() {
  const auto address = [this](DeviceId device) {
    const sim::DeviceAddress& a = simulator_->address(0, device);
    const std::string where =
        a.tcp ? "tcp:" + a.host + ":" + std::to_string(a.port) : "serial:" + a.path.string();
    const std::string serial = simulator_->with_rig([device](sim::SimRig& rig) {
      sim::RobotRig& robot = rig.robot(0);
      return device == DeviceId::kBase ? robot.base().parameters().serial : robot.laser_serial(device);
    });
    return "address = \"" + where + "\"\nserial_number = \"" + serial + "\"\n";
  };
  const std::string sonar = setup_.sonar ? "true" : "false";
  const std::string session =
      setup_.journal ? "[session]\nfolder = \"" + sessions() + "\"\njournal_period_s = 0.2\n" : "";
  const std::string rate = setup_.slow ? "skip_scans = 3\n" : "";
  // Quick to get fast, so that more faults fit into a minute; how it brakes is as configured by default.
  return "[robot]\nmodel = \"p3dx\"\n[base]\nacceleration_mps2 = 1.0\nsonar = " + sonar + "\n" +
         address(DeviceId::kBase) + "[scanner.front]\n" + address(DeviceId::kFront) + "x_m = 0.021\n" + rate +
         "[scanner.coronal]\n" + address(DeviceId::kCoronal) + "[control]\nsocket = \"" + socket() +
         "\"\nstate_folder = \"" + (setup_.process ? state_folder() : "") + "\"\n[realtime]\npolicy = \"" +
         (setup_.realtime ? "enforce" : "off") + "\"\n[log]\nlevel = \"error\"\n" + session;
}

bool WireRig::start_daemon() {
  const std::string text = configuration();
  if (!(setup_.process ? start_process(text) : start_threads(text))) return false;
  constexpr double kPatience_s = 20.0;  // a process has to come up first
  EXPECT_TRUE(wait(kPatience_s, [this] {
    if (auto connected = daemon::Client::connect(socket()); connected) client_.emplace(std::move(*connected));
    return client_.has_value();
  })) << daemon::testing::read_all(folder_.file("topometricd.log"));
  return client_.has_value();
}

bool WireRig::start_process(const std::string& configuration) {
  process_ = ChildProcess::start("topometricd", {"--config", folder_.write("robot.toml", configuration)},
                                 folder_.file("topometricd.log"), setup_.cgroup);
  return process_ != nullptr;
}

bool WireRig::start_threads(const std::string& configuration) {
  const auto loaded = daemon::parse_configuration(configuration, "test.toml");
  if (!loaded.faults.empty()) return ADD_FAILURE() << faults_text(loaded), false;
  auto listening = io::ListeningSocket::open(socket());
  if (!listening) return ADD_FAILURE() << listening.error().message, false;
  auto made = daemon::App::make(
      {loaded.values, effective_text(loaded), std::move(*listening), daemon::device_connectors(nullptr), {}});
  if (!made) return ADD_FAILURE() << made.error().message, false;
  app_ = std::move(*made);
  thread_ = std::thread([this] {
    ::pthread_setname_np(::pthread_self(), "daemon-main");
    ran_ = app_->run();
  });
  return true;
}

WireRig::~WireRig() { end_daemon(); }

void WireRig::restart_daemon() {
  end_daemon();
  map_begins_here();
  EXPECT_TRUE(start_daemon());
}

void WireRig::kill_at_once(pid_t process) { EXPECT_EQ(::kill(process, SIGKILL), 0); }

void WireRig::kill_daemon(const std::function<void()>& meanwhile, const std::function<void(pid_t)>& kill) {
  ASSERT_NE(process_, nullptr) << "needs WireSetup::process";
  client_.reset();
  kill(process_->pid());
  EXPECT_EQ(process_->wait(), 128 + SIGKILL);
  process_.reset();
  meanwhile();
  if (!setup_.journal) map_begins_here();  // a session goes on in its map
  EXPECT_TRUE(start_daemon());
}

int WireRig::run_estop() {
  const auto estop = ChildProcess::start("topometric-estop", {"--config", folder_.file("robot.toml")},
                                         folder_.file("topometric-estop.log"));
  return estop == nullptr ? -1 : estop->wait();
}

std::string WireRig::state_file(std::string_view name) const {
  return state_folder() + "/" + std::string(name);
}

void WireRig::end_daemon() {
  client_.reset();
  if (process_ != nullptr) {
    process_->signal(SIGTERM);
    EXPECT_EQ(process_->wait(), 0);
    process_.reset();
  }
  if (app_ != nullptr) app_->request_stop();
  if (thread_.joinable()) thread_.join();
  EXPECT_TRUE(ran_) << ran_.error().message;
  app_.reset();
}

namespace {

Moment look(sim::SimRig& rig) {
  Moment now;
  const sim::RobotBody& body = rig.simulation().body(0);
  now.truth = rig.truth(0);
  now.v_mps = (body.encoder_left_mps() + body.encoder_right_mps()) / 2.0;
  now.omega_radps = body.true_twist().omega_radps;
  now.stands = body.encoder_left_mps() == 0.0 && body.encoder_right_mps() == 0.0;
  now.e_stops = rig.robot(0).base().e_stops();
  now.base_bytes = rig.robot(0).base().bytes_heard();
  for (std::size_t i = 0; i < now.laser_ms.size(); ++i)
    now.laser_ms[i] = rig.robot(0).laser(static_cast<DeviceId>(i)).clock_ms(rig.now());
  return now;
}

}  // namespace

std::pair<Moment, std::vector<Json>> WireRig::strike_and_hear(const std::vector<Json>& commands) {
  machine_.restart();
  return simulator_->with_rig([&commands](sim::SimRig& rig) {
    std::pair<Moment, std::vector<Json>> result{look(rig), {}};
    for (const Json& command : commands) {
      result.second.push_back(Json::parse(sim::run_command(rig, command.dump())));
      EXPECT_EQ(result.second.back()["ok"], true) << command << " -> " << result.second.back();
    }
    return result;
  });
}

Moment WireRig::moment() { return simulator_->with_rig(look); }

Json WireRig::ask(const char* method, const Json& params) {
  auto answer = client_->call(method, params, 30s);
  EXPECT_TRUE(answer) << method << " " << params << ": " << answer.error().message;
  return answer ? *answer : Json();
}

bool WireRig::try_ask(const char* method, const Json& params) {
  return client_->call(method, params, 30s).has_value();
}

bool WireRig::is_ready() { return ask("progress").value("ready", false); }

bool WireRig::wait(double seconds, const std::function<bool()>& is_so) {
  const types::Stamp end = io::monotonic_now() + from_s(seconds);
  while (!is_so()) {
    if (io::monotonic_now() > end) return false;
    std::this_thread::sleep_for(20ms);  // between two looks; the deadline decides
  }
  return true;
}

void WireRig::map_begins_here() { world_from_map_ = moment().truth.pose; }

void WireRig::order_down_the_hall(bool to_the_east) {
  constexpr double kOffEnd_m = 2.0;
  const double here_m = moment().truth.pose.x_m;
  // Far away the beams are wider apart than the cells: what lies there is not known at first, and refused.
  for (const double way_m : {26.0, 22.0, 18.0, 14.0, 10.0}) {
    const double x_m =
        std::clamp(to_the_east ? here_m + way_m : here_m - way_m, kOffEnd_m, kEnd_x_m - kOffEnd_m);
    const types::Vector2 to = world_from_map_.inverse() * types::Vector2{x_m, kMiddle_y_m};
    if (!try_ask("goto", {{"x_m", to.x()}, {"y_m", to.y()}})) continue;
    to_the_east_ = to_the_east;
    return;
  }
}

bool WireRig::reach_full_speed(double patience_s) {
  constexpr double kRoom_m = 7.0;
  return wait(patience_s, [this] {
    const Moment now = moment();
    const double heading_rad = now.truth.pose.theta_rad;
    const double room_m = room_ahead_m(now);
    const bool straight = std::abs(std::sin(heading_rad)) < 0.15 && std::abs(now.omega_radps) < 0.15;
    if (straight && now.v_mps > 0.95 * kV_mps && room_m > kRoom_m) return true;
    const bool to_the_east = now.truth.pose.x_m < 0.5 * kEnd_x_m;
    const bool under_way = status()["mission"]["state"] == "under way";
    const bool at_the_end = room_m < kRoom_m && to_the_east_ != to_the_east;
    if ((!under_way || at_the_end) && is_ready()) order_down_the_hall(to_the_east);
    return false;
  });
}

double WireRig::room_ahead_m(const Moment& moment) {
  const types::Se2& pose = moment.truth.pose;
  return std::cos(pose.theta_rad) > 0.0 ? kEnd_x_m - pose.x_m : pose.x_m;
}

}  // namespace topo::test
