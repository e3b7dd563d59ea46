// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// All workers of the daemon in this process against the simulator's devices: for ThreadSanitizer, and for
// what a test wants to see of the inside.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>
#include <sys/resource.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <sstream>
#include <thread>
#include <vector>

#include "daemon/app/app.hpp"
#include "daemon/app/device_connectors.hpp"
#include "daemon/config/load.hpp"
#include "daemon/session/session_reader.hpp"
#include "daemon/topoctl/client.hpp"
#include "drivers/io/posix.hpp"
#include "drivers/io/unique_fd.hpp"
#include "drivers/io/unix_socket.hpp"
#include "tests/integration/room_harness.hpp"
#include "tests/unit/daemon/support/temp_dir.hpp"

namespace topo::daemon {
namespace {

using namespace std::chrono_literals;
using sim::DeviceId;

class DaemonThreads : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { block_signals(); }

  void SetUp() override {
    simulator = sim::start_in_room(sim::tcp_robot(), sim::Difficulty::none());
    ASSERT_NE(simulator, nullptr);
    spdlog::default_logger()->sinks().push_back(log_sink);
    start_daemon();
  }

  void TearDown() override {
    stop_daemon();
    EXPECT_TRUE(ran) << ran.error().message;
    app.reset();
    spdlog::default_logger()->sinks().pop_back();
  }

  void stop_daemon() {
    client.reset();
    if (app != nullptr) app->request_stop();
    if (thread.joinable()) thread.join();
  }

  void start_daemon() {
    const auto loaded = parse_configuration(configuration(), "test.toml");
    ASSERT_TRUE(loaded.faults.empty()) << faults_text(loaded);
    auto listening = io::ListeningSocket::open(socket);
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
      return "address = \"" + text_of(simulator->address(0, device)) + "\"\n";
    };
    return "[robot]\nmodel = \"p3dx\"\n[base]\n" + address(DeviceId::kBase) + "[scanner.front]\n" +
           address(DeviceId::kFront) + "x_m = 0.021\n[scanner.coronal]\n" + address(DeviceId::kCoronal) +
           "[control]\nsocket = \"" + socket + "\"\nstate_folder = \"" + folder.str() +
           "\"\n[plausibility]\nnoiseless = true\n[realtime]\npolicy = \"off\"\n[log]\nlevel = \"error\"\n" +
           "[session]\nfolder = \"" + folder.str() + "\"\njournal_period_s = 0.2\n";
  }

  Json ask(const char* method, const Json& params = Json::object()) {
    auto answer = client->call(method, params, 30s);
    EXPECT_TRUE(answer) << method << ": " << answer.error().message;
    return answer ? *answer : Json();
  }

  /// Asks for the status, which has no event for most of what it says, until it pleases; `between` runs
  /// before every question. The pause leaves the daemon, on a small machine, the time to get on.
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

  /// The session that the folder has under the name.
  slam::Session kept(const std::string& name) {
    const auto loaded = load_session(folder.file(name + ".session"));
    EXPECT_TRUE(loaded) << loaded.error().message;
    return loaded ? loaded->session : slam::Session{};
  }

  std::ostringstream log;
  std::shared_ptr<spdlog::sinks::ostream_sink_mt> log_sink =
      std::make_shared<spdlog::sinks::ostream_sink_mt>(log);
  testing::TempDir folder;
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

// The map is handed from thread to thread: to the journal, to the file, and back from the file while planning
// reads.
TEST_F(DaemonThreads, SessionsAreKeptSavedAndGoneOnWith) {
  ASSERT_TRUE(until_ready());
  const Json drive{{"v_mps", 0.3}, {"omega_radps", 0.0}};
  ASSERT_TRUE(until([](const Json& s) { return s["map"]["keyframes"] >= 3; }, [&] { ask("drive", drive); }));
  ASSERT_TRUE(until([](const Json& s) {
    return s["twist"]["v_mps"] == 0.0 && s["session"]["journal"]["keyframes"] == s["map"]["keyframes"];
  }));
  const Json before = ask("status");
  EXPECT_EQ(ask("session.save", {{"name", "room"}})["keyframes"], before["map"]["keyframes"]);
  // Around where the simulator has it.
  const double x_m = simulator->truth().pose.x_m - 4.0;
  Json where{{"name", "room"}, {"x_m", x_m + 0.3}, {"y_m", -0.2}, {"theta_rad", 0.1}};
  EXPECT_EQ(ask("session.load", where)["keyframes"], before["map"]["keyframes"]);
  const auto keyframes = before["map"]["keyframes"].get<int>() + 1;
  ASSERT_TRUE(until([&](const Json& s) {
    return s["map"]["keyframes"] == keyframes && s["map"]["revision"] > before["map"]["revision"];
  }));
  EXPECT_NEAR(ask("status")["pose"]["x_m"].get<double>(), x_m, 0.15);
  // In circles, until the first metres have matched the map that goes on: before that it is not kept.
  const Json round{{"v_mps", 0.3}, {"omega_radps", 0.5}};
  ASSERT_TRUE(until(
      [&](const Json& s) {
        return s["map"]["keyframes"] > keyframes && s["session"]["journal"]["keyframes"] > keyframes;
      },
      [&] { ask("drive", round); }));
  ASSERT_TRUE(until([](const Json& s) {
    return s["twist"]["v_mps"] == 0.0 && s["session"]["journal"]["keyframes"] == s["map"]["keyframes"];
  }));
  EXPECT_EQ(ask("session.list")["sessions"].size(), 3U) << "the saved one, and a journal of each map";
  // The map before it had grown since it was saved: nothing of the one is numbered as something of the other.
  ASSERT_FALSE(ask("session.save", {{"name", "on"}}).empty());
  const slam::Session room = kept("room"), on = kept("on");
  const std::size_t shared = room.keyframes.size();
  ASSERT_GT(on.keyframes.size(), shared);
  for (std::size_t i = 0; i < shared; ++i) EXPECT_EQ(on.keyframes[i]->id, room.keyframes[i]->id);
  for (std::size_t i = shared; i < on.keyframes.size(); ++i) {
    EXPECT_EQ(on.keyframes[i]->id.robot, 1);
    EXPECT_NE(on.keyframes[i]->id.origin(), room.keyframes[0]->id.origin());
  }
}

TEST_F(DaemonThreads, EveryStartSignsItsKeyframesWithARunOfItsOwn) {
  std::array<slam::Origin, 2> origins;
  for (slam::Origin& origin : origins) {
    if (app == nullptr) start_daemon();
    ASSERT_TRUE(until_ready());
    ASSERT_FALSE(ask("session.save", {{"name", "start"}}).empty());
    origin = kept("start").keyframes.at(0)->id.origin();
    stop_daemon();
    app.reset();
  }
  EXPECT_EQ(origins[0].robot, 1);
  EXPECT_EQ(origins[1].robot, 1);
  EXPECT_NE(origins[0].run, origins[1].run);
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
  constexpr int kEstops = 10;
  std::atomic<bool> enough{false};
  std::atomic<int> rounds{0};  // begun
  std::thread busy([&] {
    auto other = Client::connect(socket);
    EXPECT_TRUE(other);
    while (other && !enough) {
      ++rounds;
      rounds.notify_one();
      (void)other->call("map.save", {{"dir", folder.file("")}}, 30s).has_value();
      (void)other->call("goto", {{"x_m", 400.0}, {"y_m", 0.0}}, 30s).has_value();
    }
    rounds = kEstops + 1;  // nobody waits for one who has ended
    rounds.notify_one();
  });
  // The base looks every 50 ms; the other half of the 100 ms is main's. The best of some, because a test's
  // machine may be busy with other things.
  types::Duration best = 1h;
  for (int i = 0; i < kEstops; ++i) {
    for (int seen = rounds; seen <= i; seen = rounds) rounds.wait(seen);  // each among other work
    const types::Stamp begin = io::monotonic_now();
    ask("estop");
    best = std::min(best, io::monotonic_now() - begin);
  }
  enough = true;
  busy.join();
  EXPECT_LT(best, 50ms);
  ASSERT_TRUE(until([](const Json& s) {
    return s["commanded"]["v_mps"] == 0.0 && s["estop"] == true && s["mission"]["state"] == "paused";
  }));
}

TEST_F(DaemonThreads, AClearedEstopIsNoObstacleAnyMore) {
  ASSERT_TRUE(until([this](const Json&) { return ask("progress")["ready"] == true; }));
  ask("start");
  ask("estop");
  const auto latched = [](const Json& s) {
    return s["state"].get<std::string>().find("emergency") != std::string::npos;
  };
  ASSERT_TRUE(until(latched));
  ask("clear_estop");
  const auto resumed = client->call("resume", Json::object(), 30s);  // before the base has reported again
  EXPECT_TRUE(resumed) << resumed.error().message;
  ASSERT_TRUE(until([&](const Json& s) { return !latched(s); }));
  EXPECT_NE(ask("status")["mission"]["state"], "paused");
}

TEST_F(DaemonThreads, AStopEndsAWayThatIsStillLookedFor) {
  ASSERT_TRUE(until([this](const Json&) { return !ask("places")["places"].empty(); }));
  ASSERT_TRUE(until([this](const Json&) { return ask("progress")["ready"] == true; }));
  const auto both = io::connect_unix(socket);
  ASSERT_TRUE(both) << both.error().message;
  // In one piece: of one client one request a turn is served, and the search is in another thread.
  const std::string lines =
      request_line("goto", {{"x_m", 0.3}, {"y_m", 0.0}}, 1) + request_line("stop", Json::object(), 2);
  ASSERT_EQ(::send(both->get(), lines.data(), lines.size(), MSG_NOSIGNAL),
            static_cast<ssize_t>(lines.size()));
  LineBuffer answers(1 << 20);
  std::vector<std::string> got;
  while (got.size() < 2) {
    ASSERT_GT(io::wait_for(both->get(), POLLIN, 30s), 0);
    std::array<char, 4096> bytes{};
    const ssize_t n = ::recv(both->get(), bytes.data(), bytes.size(), 0);
    ASSERT_GT(n, 0);
    ASSERT_TRUE(answers.append({bytes.data(), static_cast<std::size_t>(n)}));
    while (auto line = answers.take_line()) got.push_back(*line);
  }
  // Either the stop came first, and what was found is too late, or it ended what had just begun.
  const bool first = got[0].find("\"id\":2") != std::string::npos;
  EXPECT_TRUE(parse_answer(got[first ? 0 : 1], 2)) << got[first ? 0 : 1];
  if (first) {
    EXPECT_NE(got[1].find("meanwhile"), std::string::npos) << got[1];
  }
  EXPECT_EQ(ask("status")["mission"]["state"], first ? "none" : "stopped");
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

TEST_F(DaemonThreads, AStopOfTheDaemonDoesNotWaitForAJobInHand) {
  ASSERT_TRUE(until_ready());
  // The job that opens this file waits for us to give our lease of it up, and with that says that it is
  // there.
  ::signal(SIGIO, SIG_IGN);
  const io::UniqueFd lease(::open(folder.write("endless.session", "").c_str(), O_RDWR | O_CLOEXEC));
  ASSERT_EQ(::fcntl(lease.get(), F_SETLEASE, F_WRLCK), 0) << std::strerror(errno);
  const auto other = io::connect_unix(socket);
  ASSERT_TRUE(other) << other.error().message;
  const std::string load = request_line("session.load", {{"name", "endless"}}, 1);
  ASSERT_EQ(::send(other->get(), load.data(), load.size(), MSG_NOSIGNAL), static_cast<ssize_t>(load.size()));
  ASSERT_TRUE(until([&](const Json&) { return ::fcntl(lease.get(), F_GETLEASE) != F_WRLCK; }));
  const auto base_state = [this] {
    const Json status = Json::parse(simulator->command(R"({"command":"status"})"));
    return status["robots"][0]["base"]["state"].get<std::string>();
  };
  EXPECT_EQ(base_state(), "open");
  app->request_stop();
  const types::Stamp limit = io::monotonic_now() + 20s;
  // The simulated device tells its state when asked, and no client of the daemon is answered any more.
  while (base_state() == "open" && io::monotonic_now() < limit) std::this_thread::sleep_for(20ms);
  EXPECT_NE(base_state(), "open") << "the base is still driven while the job is in hand";
  EXPECT_EQ(::fcntl(lease.get(), F_GETLEASE), F_RDLCK) << "the job went on meanwhile";
}

TEST_F(DaemonThreads, WhatAThreadSaysAtItsEndIsTold) {
  ASSERT_TRUE(until_ready());
  const Json drive{{"v_mps", 0.3}, {"omega_radps", 0.0}};
  ASSERT_TRUE(until([](const Json& s) { return s["map"]["keyframes"] >= 3; }, [&] { ask("drive", drive); }));
  ASSERT_TRUE(until([](const Json& s) {
    return s["twist"]["v_mps"] == 0.0 && s["session"]["journal"]["keyframes"] == s["map"]["keyframes"];
  }));
  // A disk that takes no more, not even the record that closes the journal.
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const rlimit none{0, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &none), 0);
  stop_daemon();
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
  EXPECT_NE(log.str().find("the session is not being kept"), std::string::npos) << log.str();
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
