// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// A robot gone wrong, on the loopback: the radio of topolink with one robot's credentials, which writes in
// the partition of the number PARTITION datagrams that say they are of robot CLAIMED, until its standard
// input ends. Exit status 3, with the words, when DDS does not let it.
//
// usage: false_number CREDENTIALS DOMAIN TEAM PARTITION CLAIMED
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>

#include "daemon/link/radio.hpp"

namespace topo::daemon {
namespace {

constexpr int kPeriod_ms = 10;

int run(const RadioPlan& plan, const LinkIdentity& claimed) {
  Radio radio(plan, claimed);
  radio.start();
  const std::array<std::byte, 200> datagram{};
  for (;;) {
    if (radio.shared().failed.load(std::memory_order_acquire)) {
      fmt::print(stderr, "false_number: {}\n", radio.shared().failure);
      return 3;
    }
    if (radio.shared().up.load(std::memory_order_acquire)) static_cast<void>(radio.send(datagram));
    pollfd ends{0, POLLIN, 0};
    ::poll(&ends, 1, kPeriod_ms);
    if ((ends.revents & (POLLHUP | POLLIN)) != 0) return 0;
  }
}

}  // namespace
}  // namespace topo::daemon

int main(int argc, char** argv) {
  using namespace topo::daemon;
  if (argc != 6) {
    fmt::print(stderr, "usage: false_number CREDENTIALS DOMAIN TEAM PARTITION CLAIMED\n");
    return 2;
  }
  RadioPlan plan;
  plan.interface = "lo";
  plan.address = "127.0.0.1";
  plan.peers = {"127.0.0.1"};
  plan.domain = static_cast<std::uint32_t>(std::atoi(argv[2]));
  plan.team = team_hash(argv[3]);
  plan.robot = static_cast<std::uint16_t>(std::atoi(argv[4]));
  plan.security = argv[1];
  const int status = run(
      plan,
      {.team = plan.team, .robot = static_cast<std::uint16_t>(std::atoi(argv[5])), .version = kLinkVersion});
  // The threads of DDS run on: a usual end would destroy what they use.
  std::fflush(nullptr);
  ::_exit(status);
}
