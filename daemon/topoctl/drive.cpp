// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <thread>

#include "daemon/topoctl/commands.hpp"
#include "drivers/io/posix.hpp"

namespace topo::daemon {
namespace {

constexpr types::Duration kPeriod = std::chrono::milliseconds(100);  // the daemon's dead man waits 300 ms

}  // namespace

int drive_for(const Arguments& arguments) {
  auto client = Client::connect(arguments.socket);
  if (!client) return complain(client.error());
  catch_signals();
  const Json params{{"v_mps", arguments.v_mps}, {"omega_radps", arguments.omega_radps}};
  const types::Stamp end = io::monotonic_now() + types::from_seconds(arguments.seconds);
  while (!interrupted() && io::monotonic_now() < end) {
    if (const auto answer = client->call("drive", params, kPatience); !answer)
      return complain(answer.error());
    std::this_thread::sleep_for(std::min(kPeriod, end - io::monotonic_now()));
  }
  const auto stopped = client->call("stop", Json::object(), kPatience);
  return stopped ? kOk : complain(stopped.error());
}

}  // namespace topo::daemon
