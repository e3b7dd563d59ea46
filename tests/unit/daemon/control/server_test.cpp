// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/control/server.hpp"
#include "tests/unit/daemon/support/temp_dir.hpp"

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>

#include <array>

namespace topo::daemon {
namespace {

/// A server on a loop that the test turns itself: no threads, no waiting for luck.
class ServerTest : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_GE(sd_event_new(&event), 0);
    auto listening = io::ListeningSocket::open(path);
    ASSERT_TRUE(listening.has_value()) << listening.error().message;
    ControlRules rules;
    rules.may_command = [this](const Peer&) { return newcomers_command; };
    server.emplace(event, std::move(*listening), std::move(rules),
                   [this](const Call& call) -> std::optional<Answer> {
                     ++calls;
                     served.push_back(call.request.method);
                     if (call.request.method == "later") {
                       kept = call;
                       return {};
                     }
                     if (call.request.method == "big") return Json(std::string(200000, 'x'));
                     return Json{{"echo", call.request.method}};
                   });
    ASSERT_TRUE(server->start().has_value());
  }
  void TearDown() override {
    server.reset();
    sd_event_unref(event);
  }

  /// Turns the loop until nothing more is due.
  void settle() {
    while (sd_event_run(event, 0) > 0) {
    }
  }
  io::UniqueFd connect() {
    auto fd = io::connect_unix(path);
    EXPECT_TRUE(fd.has_value());
    settle();
    return std::move(*fd);
  }
  void write(const io::UniqueFd& fd, std::string_view text) {
    ASSERT_EQ(::send(fd.get(), text.data(), text.size(), MSG_NOSIGNAL), static_cast<ssize_t>(text.size()));
    settle();
  }
  /// What is there to read; "closed" is noted when the server hung up.
  std::string read(const io::UniqueFd& fd) {
    std::string text;
    std::array<char, 65536> bytes{};
    while (true) {
      const ssize_t got = ::recv(fd.get(), bytes.data(), bytes.size(), MSG_DONTWAIT);
      if (got == 0 || (got < 0 && errno == ECONNRESET)) return text + "closed";
      if (got < 0) return text;
      text.append(bytes.data(), static_cast<std::size_t>(got));
      settle();
    }
  }

  testing::TempDir folder;
  std::string path = folder.file("control.sock");
  sd_event* event = nullptr;
  std::optional<ControlServer> server;
  std::optional<Call> kept;
  bool newcomers_command = true;
  std::vector<std::string> served;
  int calls = 0;
};

constexpr std::string_view kStatus = "{\"jsonrpc\":\"2.0\",\"method\":\"status\",\"id\":1}\n";

TEST_F(ServerTest, SeveralClientsEachTheirAnswer) {
  const auto a = connect(), b = connect();
  write(a, kStatus);
  write(b, "{\"jsonrpc\":\"2.0\",\"method\":\"health\",\"id\":2}\n");
  EXPECT_EQ(read(b), "{\"id\":2,\"jsonrpc\":\"2.0\",\"result\":{\"echo\":\"health\"}}\n");
  EXPECT_EQ(read(a), "{\"id\":1,\"jsonrpc\":\"2.0\",\"result\":{\"echo\":\"status\"}}\n");
}

TEST_F(ServerTest, RequestInPiecesAndTwoAtOnce) {
  const auto a = connect();
  write(a, kStatus.substr(0, 10));
  EXPECT_EQ(read(a), "");
  write(a, std::string(kStatus.substr(10)) + std::string(kStatus));
  const std::string got = read(a);
  EXPECT_EQ(std::count(got.begin(), got.end(), '\n'), 2);
}

TEST_F(ServerTest, GarbageGetsAnErrorAndTheClientMayGoOn) {
  const auto a = connect();
  write(a, "no json\n");
  EXPECT_NE(read(a).find("-32700"), std::string::npos);
  write(a, kStatus);
  EXPECT_NE(read(a).find("echo"), std::string::npos);
}

TEST_F(ServerTest, EndlessLineIsCutOff) {
  const auto a = connect();
  write(a, std::string(40000, 'x'));
  EXPECT_NE(read(a).find("closed"), std::string::npos);
  EXPECT_EQ(server->clients(), 0U);
}

TEST_F(ServerTest, NotificationIsDoneAndNotAnswered) {
  const auto a = connect();
  write(a, "{\"jsonrpc\":\"2.0\",\"method\":\"estop\"}\n");
  EXPECT_EQ(calls, 1);
  EXPECT_EQ(read(a), "");
}

TEST_F(ServerTest, LateAnswerFindsItsClientOrNobody) {
  auto a = connect();
  write(a, "{\"jsonrpc\":\"2.0\",\"method\":\"later\",\"id\":9}\n");
  EXPECT_EQ(read(a), "");
  ASSERT_TRUE(kept.has_value());
  server->answer(*kept, Json(true));
  EXPECT_EQ(read(a), "{\"id\":9,\"jsonrpc\":\"2.0\",\"result\":true}\n");
  a.reset();
  settle();
  EXPECT_EQ(server->clients(), 0U);
  server->answer(*kept, Json(true));
}

TEST_F(ServerTest, OnlySubscribersGetWhatIsPublished) {
  const auto a = connect(), b = connect();
  write(a, "{\"jsonrpc\":\"2.0\",\"method\":\"later\",\"id\":1}\n");
  ASSERT_TRUE(kept.has_value());
  server->subscribe(kept->client);
  server->publish({{"event", "done"}});
  EXPECT_EQ(read(a), "{\"jsonrpc\":\"2.0\",\"method\":\"event\",\"params\":{\"event\":\"done\"}}\n");
  EXPECT_EQ(read(b), "");
}

TEST_F(ServerTest, ClientThatDoesNotReadIsDroppedAndOthersAreServed) {
  const auto slow = connect(), quick = connect();
  for (int i = 0; i < 10 && server->clients() == 2; ++i) {
    const std::string_view big = "{\"jsonrpc\":\"2.0\",\"method\":\"big\",\"id\":1}\n";
    ::send(slow.get(), big.data(), big.size(), MSG_NOSIGNAL);
    settle();
  }
  EXPECT_EQ(server->clients(), 1U);
  write(quick, kStatus);
  EXPECT_NE(read(quick).find("echo"), std::string::npos);
}

TEST_F(ServerTest, BigAnswerArrivesWholeAtAReader) {
  const auto a = connect();
  write(a, "{\"jsonrpc\":\"2.0\",\"method\":\"big\",\"id\":1}\n");
  const std::string got = read(a);
  EXPECT_GT(got.size(), 200000U);
  EXPECT_EQ(got.back(), '\n');
}

TEST_F(ServerTest, OneMoreClientIsAlwaysTaken) {
  std::vector<io::UniqueFd> many;
  for (int i = 0; i < 40; ++i) many.push_back(connect());
  EXPECT_LE(server->clients(), 32U);
  write(many.back(), kStatus);
  EXPECT_NE(read(many.back()).find("echo"), std::string::npos);
}

/// Many clients flood; the e-stop of one more is served before whatever else waits. What they ask is not
/// answered from the cache, which would not be counted.
class FloodTest : public ServerTest {
 protected:
  static std::string request(std::string_view method) {
    return "{\"jsonrpc\":\"2.0\",\"method\":\"" + std::string(method) + "\",\"id\":1}\n";
  }
  /// Without turning the loop.
  void pour(const io::UniqueFd& fd, std::string_view method, int count) {
    std::string text;
    for (int i = 0; i < count; ++i) text += request(method);
    ASSERT_EQ(::send(fd.get(), text.data(), text.size(), MSG_NOSIGNAL), static_cast<ssize_t>(text.size()));
  }
  void connect_flooders(int commanding, int others) {
    for (int i = 0; i < commanding + others; ++i) {
      newcomers_command = i < commanding;
      flooders.push_back(connect());
    }
  }
  /// Turns the loop until `count` more requests were served.
  void serve(std::size_t count) {
    const std::size_t until = served.size() + count;
    for (int i = 0; i < 1000 && served.size() < until; ++i) sd_event_run(event, 0);
  }
  /// How many other requests are served from now on before an e-stop.
  std::size_t others_before_estop() {
    const std::size_t before = served.size();
    for (int i = 0; i < 1000; ++i) {
      const auto stop =
          std::find(served.begin() + static_cast<std::ptrdiff_t>(before), served.end(), "estop");
      if (stop != served.end()) return static_cast<std::size_t>(stop - served.begin()) - before;
      sd_event_run(event, 0);
    }
    ADD_FAILURE() << "no e-stop was served";
    return 1000;
  }

  std::vector<io::UniqueFd> flooders;
};

TEST_F(FloodTest, EstopGoesBeforeWhatOthersSent) {
  connect_flooders(20, 7);  // the victim is of the same user, who has 8 seats
  for (const bool commands : {true, false}) {
    newcomers_command = commands;
    const auto victim = connect();
    for (const auto& flooder : flooders) pour(flooder, "status", 40);
    serve(5);
    pour(victim, "estop", 1);
    EXPECT_LE(others_before_estop(), 2U) << commands;
    EXPECT_NE(read(victim).find("\"echo\":\"estop\""), std::string::npos);
  }
}

TEST_F(FloodTest, EstopOfANewConnectionGoesBeforeToo) {
  connect_flooders(20, 8);
  for (const auto& flooder : flooders) pour(flooder, "health", 40);
  serve(5);
  const auto victim = io::connect_unix(path);
  ASSERT_TRUE(victim.has_value());
  pour(*victim, "estop", 1);
  EXPECT_LE(others_before_estop(), 2U);
}

TEST_F(FloodTest, EstopGoesBeforeWhatItsOwnClientSent) {
  newcomers_command = false;
  const auto victim = connect();
  pour(victim, "status", 30);
  pour(victim, "estop", 1);
  EXPECT_LE(others_before_estop(), 2U);
}

TEST_F(FloodTest, EstopsOfOthersDoNotKeepEverythingElseOut) {
  connect_flooders(0, 8);
  const auto commander = (newcomers_command = true, connect());
  for (const auto& flooder : flooders) pour(flooder, "estop", 30);
  pour(commander, "clear_estop", 1);
  serve(3);
  EXPECT_EQ(std::count(served.begin(), served.end(), "clear_estop"), 1);
}

TEST_F(FloodTest, ThoseWhoCommandGoBeforeThoseWhoLook) {
  connect_flooders(0, 8);
  const auto commander = (newcomers_command = true, connect());
  for (const auto& flooder : flooders) pour(flooder, "status", 2);
  pour(commander, "start", 1);
  serve(1);
  EXPECT_EQ(served, std::vector<std::string>{"start"});
}

TEST_F(FloodTest, WhoHangsUpHasHisEstopServedAndHisQuestionsForgotten) {
  newcomers_command = false;
  {
    const auto victim = connect();
    pour(victim, "status", 30);
    pour(victim, "estop", 1);
  }
  settle();
  EXPECT_EQ(served, std::vector<std::string>{"estop"});
  EXPECT_EQ(server->clients(), 0U);
}

TEST_F(FloodTest, WhoOnlySendsNoMoreStillGetsHisAnswers) {
  const auto a = connect();
  pour(a, "status", 3);
  ASSERT_EQ(::shutdown(a.get(), SHUT_WR), 0);
  settle();
  const std::string got = read(a);
  EXPECT_EQ(std::count(got.begin(), got.end(), '\n'), 3);
  EXPECT_NE(got.find("closed"), std::string::npos);
}

TEST_F(FloodTest, ThoseWhoLookDoNotTakeTheSeatsOfThoseWhoCommand) {
  newcomers_command = true;
  const auto commander = connect();
  connect_flooders(0, 200);
  EXPECT_LE(server->clients(), 9U);
  pour(commander, "start", 1);
  settle();
  EXPECT_NE(read(commander).find("\"echo\":\"start\""), std::string::npos);
}

/// A user who connects with questions all the time is hung up on; his e-stop is answered nevertheless.
TEST_F(FloodTest, ConnectionsBeyondTheQuotaAreClosedButForAnEstop) {
  newcomers_command = false;
  for (int i = 0; i < 400; ++i) {
    const auto flooder = io::connect_unix(path);
    ASSERT_TRUE(flooder.has_value());
    pour(*flooder, "goals", 3);
  }
  const auto asks = io::connect_unix(path), stops = io::connect_unix(path);
  ASSERT_TRUE(asks.has_value() && stops.has_value());
  pour(*asks, "goals", 1);
  pour(*stops, "estop", 1);
  EXPECT_LE(others_before_estop(), 2U);
  EXPECT_NE(read(*stops).find("\"echo\":\"estop\""), std::string::npos);
  EXPECT_EQ(read(*asks), "closed");
}

TEST_F(FloodTest, CostlyAnswersAreGivenAgainForAMoment) {
  const auto a = connect();
  pour(a, "goals", 20);
  settle();
  const std::string got = read(a);
  EXPECT_EQ(std::count(got.begin(), got.end(), '\n'), 20);
  EXPECT_LT(calls, 20);
}

}  // namespace
}  // namespace topo::daemon
