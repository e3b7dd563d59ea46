// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <optional>

#include "daemon/topoctl/commands.hpp"
#include "daemon/topoctl/tables.hpp"
#include "drivers/io/posix.hpp"

namespace topo::daemon {
namespace {

/// The exit status when `state`, the answer to "progress", ends the wait; otherwise nothing.
using Verdict = std::function<std::optional<int>(const Json& state)>;

/// Pause between two attempts to reach a missing daemon.
constexpr types::Duration kLookAgain = std::chrono::milliseconds(200);

types::Stamp deadline_of(const Arguments& arguments) {
  const bool forever = arguments.timeout_s <= 0.0;
  return forever ? types::Stamp::max() : io::monotonic_now() + types::from_seconds(arguments.timeout_s);
}

/// Time-out of one answer: at most the remaining time.
types::Duration patience_until(types::Stamp deadline) {
  return std::min(kPatience, deadline - io::monotonic_now());
}

int too_late(const Arguments& arguments, const std::string& why) {
  fmt::print(stderr, "topoctl: not within {} s{}{}\n", arguments.timeout_s, why.empty() ? "" : ": ", why);
  return kTimedOut;
}

/// Evaluates the current state, and again after every event. An Error when the daemon is missing or lost.
types::Result<int> follow(const Arguments& arguments, types::Stamp deadline, const Verdict& verdict) {
  auto client = Client::connect(arguments.socket, patience_until(deadline));
  if (!client) return tl::unexpected(client.error());
  auto state = client->call("events.subscribe", Json::object(), patience_until(deadline));
  while (true) {
    if (!state) return tl::unexpected(state.error());
    if (const auto status = verdict(*state)) return *status;
    const auto event = next_event_until(*client, deadline);
    if (!event && event.error().code != types::Errc::kTimeout) return tl::unexpected(event.error());
    if (interrupted()) return kFailed;
    if (!event) return too_late(arguments, text_at(*state, "/why_not"));
    state = client->call("progress", Json::object(), patience_until(deadline));
  }
}

/// True when the daemon may still come, or come back.
bool is_absence(types::Errc code) {
  return code == types::Errc::kNotFound || code == types::Errc::kTimeout || code == types::Errc::kClosed;
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
  catch_signals();
  const auto verdict = [&arguments](const Json& state) -> std::optional<int> {
    const std::string now = text_at(state, "/mission/state");
    if (now == "none") {
      fmt::print(stderr, "topoctl: there was no mission since the daemon's start (topoctl start)\n");
      return kFailed;
    }
    if (now == "done") return tell(arguments, state, kOk);
    if (now == "failed" || now == "stopped") return tell(arguments, state, kMissionFailed);
    return {};
  };
  const types::Stamp deadline = deadline_of(arguments);
  const auto status = follow(arguments, deadline, verdict);
  if (!status && io::monotonic_now() >= deadline) return too_late(arguments, status.error().message);
  return status ? *status : complain(status.error());
}

int wait_ready(const Arguments& arguments) {
  catch_signals();
  const auto verdict = [&arguments](const Json& state) -> std::optional<int> {
    if (text_at(state, "/ready") != "yes") return {};
    if (arguments.json) fmt::print("{}\n", one_line(state));
    return kOk;
  };
  const types::Stamp deadline = deadline_of(arguments);
  while (true) {
    const auto status = follow(arguments, deadline, verdict);
    if (status) return *status;
    if (!is_absence(status.error().code)) return complain(status.error());
    if (interrupted()) return kFailed;
    if (io::monotonic_now() >= deadline) return too_late(arguments, status.error().message);
    pause_until(std::min(io::monotonic_now() + kLookAgain, deadline));
  }
}

}  // namespace topo::daemon
