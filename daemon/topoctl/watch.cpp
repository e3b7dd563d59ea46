// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

#include "daemon/topoctl/commands.hpp"
#include "daemon/topoctl/tables.hpp"
#include "drivers/io/posix.hpp"

namespace topo::daemon {
namespace {

void print_status(const Arguments& arguments, const Json& status, bool terminal) {
  if (arguments.json) {
    fmt::print("{}\n", one_line(status));
  } else if (terminal) {
    fmt::print("\r\033[K{}", watch_line(status));  // overwrites the previous line
  } else {
    fmt::print("{}\n", watch_line(status));
  }
  std::fflush(stdout);
}

/// Waits for the next round; true when a mission ended in the meantime.
types::Result<bool> ended_within(Client& client, types::Duration wait) {
  const types::Stamp deadline = io::monotonic_now() + wait;
  while (!interrupted()) {
    const auto event = next_event_until(client, deadline);
    if (!event && event.error().code == types::Errc::kTimeout) return false;
    if (!event) return tl::unexpected(event.error());
    if (text_at(*event, "/event") == "done") return true;
  }
  return false;
}

}  // namespace

int watch(const Arguments& arguments) {
  auto client = Client::connect(arguments.socket);
  if (!client) return complain(client.error());
  catch_signals();
  const bool terminal = ::isatty(STDOUT_FILENO) == 1;
  const auto subscribed = client->call("events.subscribe", Json::object(), kPatience);
  if (!subscribed) return complain(subscribed.error());
  types::Result<bool> ended(false);
  while (true) {
    const auto status = client->call("status", Json::object(), kPatience);
    if (!status) return complain(status.error());
    print_status(arguments, *status, terminal);
    if (*ended || interrupted()) break;
    ended = ended_within(*client, types::from_seconds(arguments.interval_s));
    if (!ended) return complain(ended.error());
  }
  if (terminal && !arguments.json) fmt::print("\n");
  return kOk;
}

}  // namespace topo::daemon
