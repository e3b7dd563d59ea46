// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// All workers of the daemon in this process against the simulator's devices: for ThreadSanitizer, and for
// what a test wants to see of the inside.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <thread>

#include "daemon/app/app.hpp"
#include "daemon/app/device_connectors.hpp"
#include "daemon/config/load.hpp"
#include "daemon/topoctl/client.hpp"
#include "drivers/io/posix.hpp"
#include "tests/sim/devices/sim_harness.hpp"
#include "tests/unit/daemon/control/temp_folder.hpp"

namespace topo::daemon {
namespace {

using namespace std::chrono_literals;
using sim::DeviceId;

/// 8 x 6 m; the robot stands in the middle and looks along x.
constexpr const char* kRoom = R"(
[[start]]
x_m = 4.0
y_m = 3.0
[[wall]]
points_m = [[-0.1, -0.1], [8.1, -0.1], [8.1, 6.1], [-0.1, 6.1]]
closed = true
thickness_m = 0.2
)";

class DaemonThreads : public testing::Test {
 protected:
  static void SetUpTestSuite() { block_signals(); }

  void SetUp() override {
    auto world = sim::World::from_scene_text(kRoom, "room.toml");
    ASSERT_TRUE(world) << world.error().message;
    sim::RigConfig config;
    config.robots.push_back(sim::tcp_robot());
    config.difficulty = sim::Difficulty::none();
    auto started = sim::SimHarness::start(std::move(*world), config);
    ASSERT_TRUE(started) << started.error().message;
    simulator = std::move(*started);
    start_daemon();
  }

  void TearDown() override {
    client.reset();
    if (app != nullptr) app->request_stop();
    if (thread.joinable()) thread.join();
    EXPECT_TRUE(ran) << ran.error().message;
    app.reset();
  }

  void start_daemon() {
    const auto loaded = parse_configuration(configuration(), "test.toml");
    ASSERT_TRUE(loaded.faults.empty()) << faults_text(loaded);
    auto listening = ListeningSocket::open(socket);
    ASSERT_TRUE(listening) << listening.error().message;
    auto made = App::make(
        {loaded.values, effective_text(loaded), std::move(*listening), device_connectors(nullptr), {}});
    ASSERT_TRUE(made) << made.error().message;
    app = std::move(*made);
    thread = std::thread([this] { ran = app->run(); });
    auto connected = Client::connect(socket);
    ASSERT_TRUE(connected) << connected.error().message;
    client.emplace(std::move(*connected));
  }

  std::string configuration() {
    const auto address = [this](DeviceId device) {
      const auto& a = simulator->address(0, device);
      return "address = \"tcp:" + a.host + ":" + std::to_string(a.port) + "\"\n";
    };
    return "[robot]\nmodel = \"p3dx\"\n[base]\n" + address(DeviceId::kBase) + "[scanner.front]\n" +
           address(DeviceId::kFront) + "x_m = 0.021\n[scanner.coronal]\n" + address(DeviceId::kCoronal) +
           "[control]\nsocket = \"" + socket + "\"\n[realtime]\npolicy = \"off\"\n[log]\nlevel = \"error\"\n";
  }

  Json ask(const char* method, const Json& params = Json::object()) {
    auto answer = client->call(method, params, 30s);
    EXPECT_TRUE(answer) << method << ": " << answer.error().message;
    return answer ? *answer : Json();
  }

  /// Asks for the status until it pleases; `between` runs before every question.
  template <class Pleases, class Between>
  bool until(Pleases pleases, Between between) {
    const types::Stamp limit = io::monotonic_now() + 60s;
    while (io::monotonic_now() < limit) {
      between();
      const Json status = ask("status");
      if (status.is_object() && pleases(status)) return true;
      std::this_thread::sleep_for(50ms);
    }
    ADD_FAILURE() << ask("status").dump(2);
    return false;
  }
  template <class Pleases>
  bool until(Pleases pleases) {
    return until(pleases, [] {});
  }
  bool until_ready() {
    return until([](const Json& s) {
      return s["devices"]["base"]["working"] == true && s["devices"]["front"]["working"] == true &&
             s["devices"]["coronal"]["working"] == true && s["map"]["keyframes"] >= 1;
    });
  }

  TempFolder folder;
  std::string socket = folder.file("control.sock");
  std::unique_ptr<sim::SimHarness> simulator;
  std::unique_ptr<App> app;
  std::optional<Client> client;
  std::thread thread;
  types::Status ran;
};

TEST_F(DaemonThreads, DrivesMapsAndSaves) {
  ASSERT_TRUE(until_ready());
  const Json drive{{"v_mps", 0.3}, {"omega_radps", 0.0}};
  const auto moved = [](const Json& s) { return s["odometry"]["x_m"] > 0.6; };
  ASSERT_TRUE(until(moved, [&] { ask("drive", drive); }));
  // Nobody asks any more: the dead man stops it.
  ASSERT_TRUE(until([](const Json& s) { return s["state"] == "standing" && s["twist"]["v_mps"] == 0.0; }));
  const sim::Truth truth = simulator->truth();
  EXPECT_EQ(truth.collisions, 0U);
  ASSERT_TRUE(until([](const Json& s) { return s["map"]["keyframes"] >= 2; }));
  const Json status = ask("status");
  EXPECT_NEAR(status["pose"]["x_m"].get<double>(), truth.pose.x_m - 4.0, 0.15);
  const Json saved = ask("map.save", {{"dir", folder.file("")}});
  EXPECT_GT(saved["width"], 100);
  for (const char* name : {"map.pgm", "map.yaml", "cloud.ply"}) {
    EXPECT_TRUE(std::filesystem::exists(folder.file(name))) << name;
  }
  EXPECT_EQ(ask("latency")["base"]["wake"]["count"] > 20, true);
}

TEST_F(DaemonThreads, EstopStopsAndLatches) {
  ASSERT_TRUE(until_ready());
  const Json drive{{"v_mps", 0.3}, {"omega_radps", 0.0}};
  ASSERT_TRUE(until([](const Json& s) { return s["twist"]["v_mps"] > 0.1; }, [&] { ask("drive", drive); }));
  ask("estop");
  ASSERT_TRUE(until([](const Json& s) {
    return s["estop"] == true && std::abs(s["twist"]["v_mps"].get<double>()) < 1e-3;
  }));
  const auto refused = client->call("drive", drive, 10s);
  EXPECT_FALSE(refused);
  ask("clear_estop");
  ASSERT_TRUE(until([](const Json& s) { return s["state"] == "standing"; }));
  ASSERT_TRUE(until([](const Json& s) { return s["twist"]["v_mps"] > 0.1; },
                    [&] { client->call("drive", drive, 10s).has_value(); }));
}

TEST_F(DaemonThreads, EstopIsNotKeptWaitingByMapsAndSearches) {
  ASSERT_TRUE(until_ready());
  ASSERT_TRUE(until([this](const Json&) { return ask("progress")["ready"] == true; }));
  ask("start");
  std::atomic<bool> enough{false};
  std::thread busy([&] {
    auto other = Client::connect(socket);
    ASSERT_TRUE(other);
    while (!enough) {
      (void)other->call("map.save", {{"dir", folder.file("")}}, 30s).has_value();
      (void)other->call("goto", {{"x_m", 400.0}, {"y_m", 0.0}}, 30s).has_value();
    }
  });
  // The base looks every 50 ms; the other half of the 100 ms is main's. The best of some, because a test's
  // machine may be busy with other things.
  types::Duration best = 1h;
  for (int i = 0; i < 10; ++i) {
    const types::Stamp begin = io::monotonic_now();
    ask("estop");
    best = std::min(best, io::monotonic_now() - begin);
    std::this_thread::sleep_for(20ms);
  }
  enough = true;
  busy.join();
  EXPECT_LT(best, 50ms);
  ASSERT_TRUE(until([](const Json& s) {
    return s["commanded"]["v_mps"] == 0.0 && s["estop"] == true && s["mission"]["state"] == "paused";
  }));
}

TEST_F(DaemonThreads, ReadyAndDoneArePushed) {
  const auto first = client->call("events.subscribe", Json::object(), 30s);
  ASSERT_TRUE(first) << first.error().message;
  const auto wait_for = [this](const char* name) {
    const types::Stamp limit = io::monotonic_now() + 60s;
    while (io::monotonic_now() < limit) {
      auto event = client->next_event(limit - io::monotonic_now());
      if (event && (*event)["event"] == name) return *event;
      if (!event) break;
    }
    ADD_FAILURE() << name << " did not come";
    return Json();
  };
  if ((*first)["ready"] != true) wait_for("ready");
  ask("home");
  EXPECT_EQ(wait_for("mission")["mission"]["order"], "home");
  EXPECT_EQ(wait_for("done")["mission"]["state"], "done");
  EXPECT_FALSE(client->call("goto", {{"x_m", 400.0}, {"y_m", 0.0}}, 30s)) << "unknown space";
}

TEST_F(DaemonThreads, LostScannerStopsTheRobotAndComesBack) {
  ASSERT_TRUE(until_ready());
  simulator->cut(0, DeviceId::kFront, 2.0);
  const Json drive{{"v_mps", 0.3}, {"omega_radps", 0.0}};
  ASSERT_TRUE(until([](const Json& s) { return s["devices"]["front"]["working"] == false; },
                    [&] { ask("drive", drive); }));
  ASSERT_TRUE(
      until([](const Json& s) { return s["commanded"]["v_mps"] == 0.0; }, [&] { ask("drive", drive); }));
  ASSERT_TRUE(until([](const Json& s) { return s["devices"]["front"]["working"] == true; }));
}

}  // namespace
}  // namespace topo::daemon
