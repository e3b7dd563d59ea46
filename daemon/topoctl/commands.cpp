// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/topoctl/commands.hpp"

#include <fmt/format.h>
#include <signal.h>

#include <algorithm>
#include <atomic>

#include "drivers/io/posix.hpp"

namespace topo::daemon {
namespace {

std::atomic<bool> was_interrupted{false};

// Long waits check for an interruption in this period: a signal between a check and a longer wait would be
// lost, and the operator does not notice the delay.
constexpr types::Duration kSlice = std::chrono::milliseconds(100);

}  // namespace

bool interrupted() { return was_interrupted.load(std::memory_order_relaxed); }

void catch_signals() {
  struct sigaction action {};
  action.sa_handler = [](int) { was_interrupted.store(true, std::memory_order_relaxed); };
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
  ::sigaction(SIGHUP, &action, nullptr);
}

void pause_until(types::Stamp when) {
  for (types::Stamp now = io::monotonic_now(); now < when && !interrupted(); now = io::monotonic_now())
    io::sleep_until(std::min(when, now + kSlice));
}

types::Result<Json> next_event_until(Client& client, types::Stamp deadline) {
  while (true) {
    const types::Stamp now = io::monotonic_now();
    auto event = client.next_event(std::min(deadline - now, kSlice));
    const bool in_vain = !event && event.error().code == types::Errc::kTimeout;
    if (!in_vain || interrupted() || io::monotonic_now() >= deadline) return event;
  }
}

int status_of(const types::Error& error) {
  return error.code == types::Errc::kNotFound || error.code == types::Errc::kTimeout ? kNoDaemon : kFailed;
}

int complain(const types::Error& error) {
  fmt::print(stderr, "topoctl: {}\n", error.message);
  return status_of(error);
}

std::string pretty(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace); }
std::string one_line(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

types::Result<Json> ask(const Arguments& arguments, const char* method, const Json& params,
                        types::Duration patience) {
  auto client = Client::connect(arguments.socket, patience);
  if (!client) return tl::unexpected(client.error());
  auto answer = client->call(method, params, patience);
  // A refusal by the daemon must not be taken for a missing daemon.
  if (!answer && answer.error().code == types::Errc::kNotFound)
    return types::fail(types::Errc::kIo, answer.error().message);
  return answer;
}

int show(const Arguments& arguments, const char* method, std::string (*table)(const Json&),
         const Json& params, types::Duration patience) {
  const auto answer = ask(arguments, method, params, patience);
  if (!answer) return complain(answer.error());
  if (arguments.json) {
    fmt::print("{}\n", pretty(*answer));
  } else {
    fmt::print("{}", table(*answer));
  }
  return kOk;
}

}  // namespace topo::daemon
