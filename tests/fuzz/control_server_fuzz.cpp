// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// Several clients of the control socket as byte streams, written in pieces of any size in any order, hanging
// up at any time: every answer is one line of JSON, and every e-stop that was sent whole is served, after two
// other requests at most. The input is a list of acts: what and which client (two bits each way), a length,
// and bytes.
#include <sys/socket.h>
#include <systemd/sd-event.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>

#include "daemon/control/server.hpp"
#include "tests/unit/daemon/support/temp_dir.hpp"

namespace {

using namespace topo;
using namespace topo::daemon;

constexpr std::string_view kEstop = "\n{\"jsonrpc\":\"2.0\",\"method\":\"estop\",\"id\":1}\n";
constexpr std::string_view kGoals = "{\"jsonrpc\":\"2.0\",\"method\":\"goals\",\"id\":2}\n";
// What a client may send so that the server reads all of it before each turn: one read and its queue.
constexpr std::size_t kOneRead = 4000, kOneQueue = 60;

void require(bool holds, int line = __builtin_LINE()) {
  if (holds) return;
  std::fprintf(stderr, "control_server_fuzz: line %d does not hold\n", line);
  std::abort();
}

std::string socket_path() {
  static const topo::daemon::testing::TempDir folder;  // of all runs
  return folder.file("control");
}

struct Client {
  io::UniqueFd fd;
  std::size_t bytes = 0, lines = 0;
  std::string answers;
};

/// A server on a loop that the script turns.
class Rig {
 public:
  Rig() {
    require(sd_event_new(&event_) >= 0);
    auto listening = io::ListeningSocket::open(socket_path());
    require(listening.has_value());
    ControlRules rules;
    rules.may_command = [this](const Peer&) { return newcomers_command_; };
    server_.emplace(event_, std::move(*listening), std::move(rules),
                    [this](const Call& call) { return handle(call); });
    require(server_->start().has_value());
  }
  ~Rig() {
    server_.reset();
    sd_event_unref(event_);
  }
  Rig(const Rig&) = delete;
  Rig& operator=(const Rig&) = delete;

  void act(unsigned what, std::size_t which, std::string_view bytes) {
    Client& client = clients_[which];
    switch (what) {
      case 0:
      case 1:
        newcomers_command_ = what == 0;
        return connect(client);
      case 2:
        return static_cast<void>(send(client, bytes));
      case 3:
        return send_estop(client);
      case 4:
        if (client.fd.valid()) ::shutdown(client.fd.get(), SHUT_WR);
        return;
      case 5:
        return client.fd.reset();
      case 6:
        return read(client);
      case 7:
        for (std::size_t i = 0; i < bytes.size() % 32; ++i) send(client, kGoals);
        return;
      case 8:
        return answer_late();
      case 9:
        return server_->publish({{"event", "fuzz"}});
      default:
        turn(bytes.size() % 8);
    }
  }
  /// Everything that is due is done; then nothing that was sent whole may be left out.
  void end() {
    turn(100'000);
    // The loop may let a turn wait for a millisecond.
    while (stops_due_ > 0 && sd_event_run(event_, 1'000'000) > 0) {
    }
    require(stops_due_ <= 0);
    while (late_) answer_late();
    turn(100'000);
    for (Client& client : clients_) read(client);
  }

 private:
  std::optional<Answer> handle(const Call& call) {
    if (call.request.method == kEstopMethod) {
      --stops_due_;
      others_ = 0;
    } else {
      // Counted while one is due of which the server knows.
      require(stops_due_ <= 0 || ++others_ <= 2);
    }
    if (call.request.method == "subscribe") server_->subscribe(call.client);
    if (call.request.method != "later" || late_) return Answer(Json{{"echo", call.request.params}});
    late_ = call;
    return {};
  }
  void answer_late() {
    if (!late_) return;
    const Call call = *late_;
    late_.reset();
    server_->answer(call, Json(true));
  }
  void turn(std::size_t most) {
    for (std::size_t i = 0; i < most && sd_event_run(event_, 0) > 0; ++i) {
    }
  }
  static void connect(Client& client) {
    client = Client{};
    if (auto fd = io::connect_unix(socket_path())) client.fd = std::move(*fd);
  }
  static bool send(Client& client, std::string_view bytes) {
    if (!client.fd.valid()) return false;
    const ssize_t sent = ::send(client.fd.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent != static_cast<ssize_t>(bytes.size())) {
      client.bytes = kOneRead;  // cut: what follows is no line of its own
      return false;
    }
    client.bytes += bytes.size();
    client.lines += static_cast<std::size_t>(std::count(bytes.begin(), bytes.end(), '\n'));
    return true;
  }
  void send_estop(Client& client) {
    const bool heard = client.bytes + kEstop.size() < kOneRead && client.lines + 2 < kOneQueue;
    if (!send(client, kEstop) || !heard) return;
    if (stops_due_ < 0) stops_due_ = 0;  // of e-stops that the input spelt
    if (stops_due_++ == 0) others_ = 0;
  }
  void read(Client& client) {
    if (!client.fd.valid()) return;
    std::array<char, 65536> bytes{};
    ssize_t got = 0;
    while ((got = ::recv(client.fd.get(), bytes.data(), bytes.size(), MSG_DONTWAIT)) > 0) {
      client.answers.append(bytes.data(), static_cast<std::size_t>(got));
      turn(10);
    }
    std::size_t begin = 0;
    for (std::size_t end = client.answers.find('\n'); end != std::string::npos;
         end = client.answers.find('\n', begin)) {
      const Json line = Json::parse(client.answers.substr(begin, end - begin), nullptr, false);
      require(line.is_object() && line.value("jsonrpc", "") == "2.0");
      begin = end + 1;
    }
    client.answers.erase(0, begin);
  }

  sd_event* event_ = nullptr;
  std::optional<ControlServer> server_;
  std::array<Client, 12> clients_;
  std::optional<Call> late_;
  bool newcomers_command_ = true;
  int stops_due_ = 0;  ///< sent whole and not yet served
  int others_ = 0;     ///< served since, or since the last e-stop
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Rig rig;
  std::string_view rest(reinterpret_cast<const char*>(data), size);
  while (rest.size() >= 2) {
    const auto head = static_cast<unsigned char>(rest[0]);
    const std::size_t length = std::min<std::size_t>(static_cast<unsigned char>(rest[1]), rest.size() - 2);
    rig.act(head & 0xFU, (head >> 4U) % 12, rest.substr(2, length));
    rest.remove_prefix(2 + length);
  }
  rig.end();
  return 0;
}
