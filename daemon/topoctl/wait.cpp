// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <functional>
#include <optional>

#include "daemon/topoctl/commands.hpp"
#include "daemon/topoctl/tables.hpp"
#include "drivers/io/posix.hpp"

namespace topo::daemon {
namespace {

/// Exit status when `state` answers the question, else nothing. `state` is what "progress" gives.
using Verdict = std::function<std::optional<int>(const Json& state)>;

/// Looks at what holds now, then again after every event.
int wait_until(const Arguments& arguments, const Verdict& verdict) {
  auto client = Client::connect(arguments.socket);
  if (!client) return complain(client.error());
  catch_signals();
  const bool forever = arguments.timeout_s <= 0.0;
  const types::Stamp deadline =
      forever ? types::Stamp::max() : io::monotonic_now() + types::from_seconds(arguments.timeout_s);
  auto state = client->call("events.subscribe", Json::object(), kPatience);
  while (true) {
    if (!state) return complain(state.error());
    if (const auto status = verdict(*state)) return *status;
    const auto event = next_event_until(*client, deadline);
    if (!event && event.error().code != types::Errc::kTimeout) return complain(event.error());
    if (interrupted()) return kFailed;
    if (!event) {
      fmt::print(stderr, "topoctl: not within {} s\n", arguments.timeout_s);
      return kTimedOut;
    }
    state = client->call("progress", Json::object(), kPatience);
  }
}

int tell(const Arguments& arguments, const Json& state, int status) {
  const Json mission = state.value("mission", Json::object());
  if (arguments.json) {
    fmt::print("{}\n", one_line(mission));
  } else {
    fmt::print("{}", mission_text(mission));
  }
  return status;
}

}  // namespace

int wait_done(const Arguments& arguments) {
  return wait_until(arguments, [&arguments](const Json& state) -> std::optional<int> {
    const std::string now = text_at(state, "/mission/state");
    if (now == "none") {
      fmt::print(stderr, "topoctl: there was no mission since the daemon's start (topoctl start)\n");
      return kFailed;
    }
    if (now == "done") return tell(arguments, state, kOk);
    if (now == "failed" || now == "stopped") return tell(arguments, state, kMissionFailed);
    return {};
  });
}

int wait_ready(const Arguments& arguments) {
  return wait_until(arguments, [&arguments](const Json& state) -> std::optional<int> {
    if (text_at(state, "/ready") != "yes") return {};
    if (arguments.json) fmt::print("{}\n", one_line(state));
    return kOk;
  });
}

}  // namespace topo::daemon
