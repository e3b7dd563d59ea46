// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// The kernel's answers about an interface, of any content: nothing is read beyond the message, and what is
// complained about has a cure. The input is read as it is, and as the attributes of a good answer about a CAN
// interface.
#include <linux/if_link.h>
#include <linux/rtnetlink.h>
#include <net/if_arp.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <span>
#include <vector>

#include "drivers/io/can_interface.hpp"

namespace {

using namespace topo::io;

void require(bool holds) {
  if (!holds) std::abort();
}

void check(std::span<const std::byte> message) {
  // On the heap and no longer than it is: a read beyond its end is found.
  const std::vector<std::byte> exact(message.begin(), message.end());
  const CanInterface interface = parse_link(exact);
  if (!interface.is_can)
    require(!interface.bit_rate_bps && !interface.restart_ms && !interface.state && !interface.errors);
  if (!interface.exists) require(!interface.is_can && !interface.up && interface.queue_length == 0);
  if (interface.state) require(*interface.state <= CanState::kSleeping);
  const auto complaint = complaint_about(interface, "can0");
  if (!interface.exists || !interface.up) require(complaint.has_value());
  if (complaint) require(!complaint->found.empty() && !complaint->cure.empty());
}

std::vector<std::byte> answered(std::span<const std::byte> attributes) {
  nlmsghdr head{};
  head.nlmsg_len = static_cast<std::uint32_t>(NLMSG_LENGTH(sizeof(ifinfomsg)) + attributes.size());
  head.nlmsg_type = RTM_NEWLINK;
  ifinfomsg link{};
  link.ifi_type = ARPHRD_CAN;
  link.ifi_flags = attributes.size() % 2 == 0 ? 1U : 0U;  // up, or not
  std::vector<std::byte> message(NLMSG_LENGTH(sizeof link));
  std::memcpy(message.data(), &head, sizeof head);
  std::memcpy(message.data() + NLMSG_HDRLEN, &link, sizeof link);
  message.insert(message.end(), attributes.begin(), attributes.end());
  return message;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto bytes = std::as_bytes(std::span(data, size));
  check(bytes);
  check(answered(bytes));
  return 0;
}
