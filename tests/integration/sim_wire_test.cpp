// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// The simulation in a thread of the test's process, as integration tests run it: clients talk to it over true
// sockets while faults come from the test's thread. Runs under ThreadSanitizer.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "tests/sim/devices/file_descriptor.hpp"
#include "tests/sim/devices/sim_harness.hpp"

namespace topo::sim {
namespace {

using namespace std::chrono_literals;
using nlohmann::json;

constexpr auto kPatience = 10s;

World room() {
  auto world = World::from_scene_text(R"(
[[start]]
x_m = 2.0
y_m = 3.0
[[start]]
x_m = 6.0
y_m = 3.0
[[wall]]
points_m = [[-0.1, -0.1], [8.1, -0.1], [8.1, 6.1], [-0.1, 6.1]]
closed = true
thickness_m = 0.2
)",
                                      "room.toml");
  EXPECT_TRUE(world.has_value()) << world.error().message;
  return std::move(*world);
}

std::unique_ptr<SimHarness> start(const RigConfig& config) {
  auto harness = SimHarness::start(room(), config);
  EXPECT_TRUE(harness.has_value()) << harness.error().message;
  return harness.has_value() ? std::move(*harness) : nullptr;
}

RigConfig two_tcp_robots() {
  RigConfig config;
  config.robots = {tcp_robot(), tcp_robot()};
  return config;
}

/// A client of its own few lines.
class Client {
 public:
  explicit Client(const DeviceAddress& address) : fd_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(address.port);
    ::inet_pton(AF_INET, address.host.c_str(), &to.sin_addr);
    connected_ = ::connect(fd_.get(), reinterpret_cast<const sockaddr*>(&to), sizeof(to)) == 0;
  }

  void send(const std::string& text) {
    ASSERT_EQ(::send(fd_.get(), text.data(), text.size(), MSG_NOSIGNAL), static_cast<ssize_t>(text.size()));
  }
  /// Reads until the condition holds on all that came; false when the time is up or the link is gone.
  bool read_until(const std::function<bool(const std::string&)>& condition,
                  std::chrono::milliseconds patience) {
    const auto deadline = std::chrono::steady_clock::now() + patience;
    while (!condition(all_)) {
      if (std::chrono::steady_clock::now() > deadline || !read_some()) return false;
    }
    return true;
  }
  bool wait_for(const std::string& text) {
    return read_until([&](const std::string& all) { return all.find(text) != std::string::npos; }, kPatience);
  }
  [[nodiscard]] bool wait_for_end() {
    const auto deadline = std::chrono::steady_clock::now() + kPatience;
    while (read_some()) {
      if (std::chrono::steady_clock::now() > deadline) return false;
    }
    return true;
  }
  [[nodiscard]] bool connected() const { return connected_; }
  void forget() { all_.clear(); }

 private:
  /// False at the end of the link.
  bool read_some() {
    pollfd ready{fd_.get(), POLLIN, 0};
    if (::poll(&ready, 1, 50) <= 0) return true;
    std::array<char, 65536> buffer;
    const auto got = ::recv(fd_.get(), buffer.data(), buffer.size(), 0);
    if (got <= 0) return false;
    all_.append(buffer.data(), static_cast<std::size_t>(got));
    return true;
  }

  FileDescriptor fd_;
  bool connected_ = false;
  std::string all_;
};

/// Looks again and again: what a client does to a simulation has no event that a test could wait for.
bool eventually(const std::function<bool()>& condition) {
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::sleep_for(2ms);
  }
  return true;
}

TEST(SimHarness, TwoRobotsStreamAtOnce) {
  auto sim = start(two_tcp_robots());
  ASSERT_NE(sim, nullptr);
  Client first(sim->address(0, DeviceId::kFront));
  Client second(sim->address(1, DeviceId::kCoronal));
  first.send("MD0000108001003\n");
  second.send("ME0000108001003\n");
  EXPECT_TRUE(first.wait_for("MD0000108001000\n99b\n"));
  EXPECT_TRUE(second.wait_for("ME0000108001000\n99b\n"));
  EXPECT_NEAR(sim->truth(0).pose.x_m, 2.0, 1e-9);
  EXPECT_NEAR(sim->truth(1).pose.x_m, 6.0, 1e-9);
}

TEST(SimHarness, ASecondClientIsTurnedAway) {
  auto sim = start(two_tcp_robots());
  ASSERT_NE(sim, nullptr);
  Client first(sim->address(0, DeviceId::kFront));
  first.send("BM\n");
  ASSERT_TRUE(first.wait_for("BM\n00P\n\n"));
  Client second(sim->address(0, DeviceId::kFront));
  EXPECT_TRUE(second.wait_for_end());
  first.send("VV\n");
  EXPECT_TRUE(first.wait_for("SERI:"));
}

TEST(SimHarness, AClientThatComesBackAtOnceFindsTheSensorIdle) {
  auto sim = start(two_tcp_robots());
  ASSERT_NE(sim, nullptr);
  for (int round = 0; round < 20; ++round) {
    Client client(sim->address(0, DeviceId::kFront));
    client.send("II\n");
    ASSERT_TRUE(client.wait_for("LASR:OFF;")) << "round " << round;
    client.send("MD0000108001000\n");
    ASSERT_TRUE(client.wait_for("MD0000108001000\n00P\n\n")) << "round " << round;
    client.send("V");  // half a request that nobody will end
  }
}

TEST(SimHarness, ACutLinkComesBackAtTheSamePlace) {
  auto sim = start(two_tcp_robots());
  ASSERT_NE(sim, nullptr);
  Client first(sim->address(0, DeviceId::kFront));
  first.send("MD0000108001000\n");
  ASSERT_TRUE(first.wait_for("\n99b\n"));
  sim->cut(0, DeviceId::kFront, 0.2);
  EXPECT_TRUE(first.wait_for_end());
  EXPECT_FALSE(Client(sim->address(0, DeviceId::kFront)).connected());
  EXPECT_TRUE(eventually([&] { return Client(sim->address(0, DeviceId::kFront)).connected(); }));
}

TEST(SimHarness, SilenceAndDeathOfASensor) {
  auto sim = start(two_tcp_robots());
  ASSERT_NE(sim, nullptr);
  Client client(sim->address(0, DeviceId::kFront));
  sim->silence(0, DeviceId::kFront, 0.3);
  client.send("VV\n");
  EXPECT_FALSE(client.read_until([](const std::string& all) { return !all.empty(); }, 200ms));
  EXPECT_TRUE(eventually([&] {
    client.send("VV\n");
    return client.read_until([](const std::string& all) { return !all.empty(); }, 100ms);
  }));
  sim->dead(0, DeviceId::kFront, ScipHealth::kFault);
  client.send("II\n");
  EXPECT_TRUE(client.wait_for("STAT:Trouble!!"));
  sim->reset(0, DeviceId::kFront);
  client.forget();
  client.send("BM\n");
  EXPECT_TRUE(client.wait_for("BM\n00P"));
}

TEST(SimHarness, AClientThatDoesNotReadHoldsNothingUp) {
  auto sim = start(two_tcp_robots());
  ASSERT_NE(sim, nullptr);
  Client lazy(sim->address(0, DeviceId::kFront));
  lazy.send("ME0000108001000\n");
  // A slow link makes it short: without it the kernel's buffers swallow seconds of scans.
  sim->slow(0, DeviceId::kFront, 1000.0);
  const double before = sim->truth(0).sim_s;
  Client other(sim->address(1, DeviceId::kFront));
  other.send("MD0000108001000\n");
  EXPECT_TRUE(eventually([&] {
    return sim->with_rig(
               [](SimRig& rig) { return rig.robot(0).laser(DeviceId::kFront).output().dropped(); }) > 0;
  }));
  EXPECT_TRUE(other.wait_for("\n99b\n"));
  EXPECT_GT(sim->truth(0).sim_s, before);
}

TEST(SimHarness, CommandsAreCheckedBeforeAnythingHappens) {
  auto sim = start(two_tcp_robots());
  ASSERT_NE(sim, nullptr);
  const auto error = [&](const std::string& line) {
    const json answer = json::parse(sim->command(line), nullptr, false);
    EXPECT_FALSE(answer.value("ok", true)) << line;
    return answer.value("error", std::string());
  };
  EXPECT_NE(error("{").find("one JSON object"), std::string::npos);
  EXPECT_NE(error(R"({"command":"explode"})").find("unknown command \"explode\""), std::string::npos);
  EXPECT_NE(error(R"({"command":"cut"})").find("\"device\" is missing, expected one of front"),
            std::string::npos);
  EXPECT_NE(error(R"({"command":"cut","device":"front","robot":2})").find("\"robot\" is 2"),
            std::string::npos);
  EXPECT_NE(error(R"({"command":"drop","device":"base","rate":1.5})").find("from 0"), std::string::npos);
  EXPECT_NE(error(R"({"command":"battery","volts":12,"colour":1})").find("unknown argument \"colour\""),
            std::string::npos);
  EXPECT_NE(error(R"({"command":"dead","device":"base"})").find("expected one of front, coronal"),
            std::string::npos);
  EXPECT_NE(error(R"({"command":"obstacle","distance_m":3.5})"), "") << "robot 1 stands there";
  EXPECT_NE(error(R"({"command":"carry","x_m":6.0,"y_m":3.0})").find("something stands there"),
            std::string::npos);
  EXPECT_NE(error(R"({"command":"delay","device":"base","seconds":-1})").find("from 0"), std::string::npos);
  EXPECT_NE(error(R"({"command":"lie","field":"colour"})").find("expected one of none, speed"),
            std::string::npos);
  EXPECT_NE(error(R"({"command":"empty","device":"front","from_deg":9,"to_deg":-9})").find("not beyond"),
            std::string::npos);
  EXPECT_NE(error(R"({"command":"half-open","device":"base"})").find("no client"), std::string::npos);
  EXPECT_NE(error(R"({"command":"steps","device":"front","start":9,"end":99})").find("does not stream"),
            std::string::npos);
}

TEST(SimHarness, EveryCommandWorksOnARunningSimulation) {
  auto sim = start(two_tcp_robots());
  ASSERT_NE(sim, nullptr);
  for (const char* line : {R"({"command":"truth"})",
                           R"({"command":"status"})",
                           R"({"command":"silence","device":"front","seconds":0.01})",
                           R"({"command":"garbage","device":"coronal","bytes":10})",
                           R"({"command":"slow","device":"base","bytes_per_s":0})",
                           R"({"command":"drop","device":"base","rate":0.5,"robot":1})",
                           R"({"command":"dead","device":"coronal","mode":"good"})",
                           R"({"command":"stop-button","pressed":false})",
                           R"({"command":"bumper","front":3})",
                           R"({"command":"battery","volts":11.5})",
                           R"({"command":"clock-jump","device":"front","ms":-5})",
                           R"({"command":"delay","device":"base","seconds":0.1,"way":"to"})",
                           R"({"command":"lose","rate":0.1})",
                           R"({"command":"disobey","on":false})",
                           R"({"command":"lie","field":"speed","value":-6})",
                           R"({"command":"encoder","side":"left"})",
                           R"({"command":"motors-off"})",
                           R"({"command":"stall","right":false})",
                           R"({"command":"sonar","range_m":0})",
                           R"({"command":"watchdog","ms":0})",
                           R"({"command":"freeze","device":"front"})",
                           R"({"command":"empty","device":"front"})",
                           R"({"command":"cover","device":"coronal","to_deg":30})",
                           R"({"command":"swap"})",
                           R"({"command":"foreign","device":"base"})",
                           R"({"command":"replace","device":"front"})",
                           R"({"command":"repeat","device":"base"})",
                           R"({"command":"replay","device":"coronal"})",
                           R"({"command":"unplug","robot":1})",
                           R"({"command":"carry","x_m":2,"y_m":2})",
                           R"({"command":"reset","device":"base"})",
                           R"({"command":"cut","device":"base","seconds":0.01})"}) {
    EXPECT_TRUE(json::parse(sim->command(line)).value("ok", false)) << line << sim->command(line);
  }
  const json box = json::parse(sim->command(R"({"command":"obstacle","distance_m":1.0})"));
  ASSERT_TRUE(box.value("ok", false)) << box.dump();
  const auto remove = [&sim](const json& id) {
    return json::parse(sim->command(json{{"command", "remove-obstacle"}, {"id", id}}.dump()));
  };
  for (const json& none : {json(77), json(0), json(box["id"].get<double>() + 0.5), json(-1), json("box")}) {
    EXPECT_FALSE(remove(none).value("ok", true)) << none.dump();
    EXPECT_NE(remove(none).value("error", "").find("expected"), std::string::npos) << remove(none).dump();
  }
  EXPECT_TRUE(remove(box["id"]).value("ok", false));
}

TEST(SimHarness, AHalfOpenLinkSaysNothingAndListensAnew) {
  auto sim = start(two_tcp_robots());
  ASSERT_NE(sim, nullptr);
  Client first(sim->address(0, DeviceId::kFront));
  first.send("VV\n");
  EXPECT_TRUE(first.read_until([](const std::string& all) { return all.find("SERI") != std::string::npos; },
                               kPatience));
  ASSERT_TRUE(json::parse(sim->command(R"({"command":"half-open","device":"front"})")).value("ok", false));
  first.send("II\n");
  EXPECT_FALSE(
      first.read_until([](const std::string& all) { return all.find("MODL") != std::string::npos; }, 300ms));
  Client second(sim->address(0, DeviceId::kFront));
  second.send("VV\n");
  EXPECT_TRUE(second.read_until([](const std::string& all) { return all.find("SERI") != std::string::npos; },
                                kPatience));
}

TEST(SimHarness, WritesTheTruthAndAnswersOnItsSocket) {
  const auto folder =
      std::filesystem::temp_directory_path() / ("topo_sim_wire_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  RigConfig config = two_tcp_robots();
  config.truth_file = folder / "truth.tsv";
  config.control_socket = folder / "control.sock";
  {
    auto sim = start(config);
    ASSERT_NE(sim, nullptr);
    const auto second = SimHarness::start(room(), config);
    ASSERT_FALSE(second.has_value()) << "a second simulation took the socket of the first";
    EXPECT_EQ(second.error().code, types::Errc::kBusy);
    const auto answer = ask_control(config.control_socket, R"({"command":"truth"})", 5000);
    ASSERT_TRUE(answer.has_value()) << answer.error().message;
    EXPECT_EQ(json::parse(*answer)["robots"].size(), 2U);
    EXPECT_TRUE(eventually([&] { return sim->truth(0).sim_s > 0.35; }));
  }
  EXPECT_FALSE(std::filesystem::exists(config.control_socket));
  std::ifstream file(folder / "truth.tsv.1");
  std::string line;
  int lines = 0;
  while (std::getline(file, line)) {
    if (line.front() == '#') continue;
    EXPECT_NE(line.find("\t6.00000\t3.00000\t"), std::string::npos) << line;
    ++lines;
  }
  EXPECT_GE(lines, 4);
  std::filesystem::remove_all(folder);
}

TEST(SimHarness, RefusesWhatCannotBe) {
  RigConfig config = two_tcp_robots();
  config.robots[1].start = Se2{-0.1, 3.0, 0.0};
  EXPECT_FALSE(SimHarness::start(room(), config).has_value()) << "a start in a wall";
  config = two_tcp_robots();
  config.robots.push_back(tcp_robot());
  auto none = SimHarness::start(room(), config);
  ASSERT_FALSE(none.has_value());
  EXPECT_NE(none.error().message.find("robot 2 has no start"), std::string::npos) << none.error().message;
  config = two_tcp_robots();
  config.control_socket = "/nowhere/at/all.sock";
  auto unreachable = SimHarness::start(room(), config);
  ASSERT_FALSE(unreachable.has_value());
  EXPECT_EQ(unreachable.error().code, types::Errc::kNotFound);
  auto first = start(two_tcp_robots());
  ASSERT_NE(first, nullptr);
  config = two_tcp_robots();
  config.robots[0].links[0].tcp_port = first->address(0, DeviceId::kFront).port;
  auto taken = SimHarness::start(room(), config);
  ASSERT_FALSE(taken.has_value());
  EXPECT_EQ(taken.error().code, types::Errc::kBusy);
}

}  // namespace
}  // namespace topo::sim
