// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/io/can_interface.hpp"

#include <linux/can/netlink.h>
#include <linux/if_link.h>
#include <linux/rtnetlink.h>
#include <net/if.h>
#include <net/if_arp.h>
#include <poll.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <vector>

#include "drivers/io/posix.hpp"
#include "drivers/io/unique_fd.hpp"

namespace topo::io {
namespace {

using types::Errc;
using types::Result;

using Bytes = std::span<const std::byte>;

/// Calls see(type, content) for every attribute of a chain; stops at the first that does not fit.
template <class See>
void for_each_attribute(Bytes chain, const See& see) {
  constexpr unsigned kTypeMask = 0x3FFF;  // NLA_TYPE_MASK without the two flags above it
  while (chain.size() >= sizeof(rtattr)) {
    rtattr head{};
    std::memcpy(&head, chain.data(), sizeof head);
    if (head.rta_len < sizeof head || head.rta_len > chain.size()) return;
    see(head.rta_type & kTypeMask, chain.subspan(RTA_LENGTH(0), head.rta_len - RTA_LENGTH(0)));
    const std::size_t step = RTA_ALIGN(head.rta_len);
    if (step > chain.size()) return;
    chain = chain.subspan(step);
  }
}

template <class Value>
std::optional<Value> value_of(Bytes content) {
  if (content.size() < sizeof(Value)) return std::nullopt;
  Value value{};
  std::memcpy(&value, content.data(), sizeof value);
  return value;
}

void take_can(CanInterface& interface, unsigned type, Bytes content) {
  if (type == IFLA_CAN_RESTART_MS) interface.restart_ms = value_of<std::uint32_t>(content);
  // The bit rate is the first member of the structure in all its versions.
  if (type == IFLA_CAN_BITTIMING) interface.bit_rate_bps = value_of<std::uint32_t>(content);
  if (type == IFLA_CAN_STATE) {
    const auto state = value_of<std::uint32_t>(content);
    if (state && *state <= CAN_STATE_SLEEPING) interface.state = static_cast<CanState>(*state);
  }
  if (type == IFLA_CAN_BERR_COUNTER) {
    const auto counters = value_of<can_berr_counter>(content);
    const auto byte = [](unsigned v) { return static_cast<std::uint8_t>(v > 255 ? 255 : v); };
    if (counters) interface.errors = CanErrorCounters{byte(counters->txerr), byte(counters->rxerr)};
  }
}

void take_link_info(CanInterface& interface, Bytes info) {
  for_each_attribute(info, [&](unsigned type, Bytes content) {
    if (type != IFLA_INFO_DATA || !interface.is_can) return;
    for_each_attribute(content, [&](unsigned inner, Bytes value) { take_can(interface, inner, value); });
  });
}

struct LinkRequest {
  nlmsghdr head{};
  ifinfomsg link{};
  rtattr name_head{};
  std::array<char, IFNAMSIZ> name{};
};

/// Sends one request and receives one answer.
Result<std::vector<std::byte>> ask(const std::string& name) {
  constexpr int kAnswerTime_ms = 200;
  LinkRequest request;
  request.head.nlmsg_len = sizeof request;
  request.head.nlmsg_type = RTM_GETLINK;
  request.head.nlmsg_flags = NLM_F_REQUEST;
  request.name_head = {static_cast<unsigned short>(RTA_LENGTH(IFNAMSIZ)), IFLA_IFNAME};
  name.copy(request.name.data(), IFNAMSIZ - 1);
  const UniqueFd fd(::socket(AF_NETLINK, SOCK_RAW | SOCK_CLOEXEC | SOCK_NONBLOCK, NETLINK_ROUTE));
  if (!fd.valid()) return fail_errno(name, "asking the kernel", errno);
  if (::send(fd.get(), &request, sizeof request, 0) < 0) return fail_errno(name, "asking the kernel", errno);
  if (wait_for(fd.get(), POLLIN, std::chrono::milliseconds(kAnswerTime_ms)) <= 0)
    return types::fail(Errc::kTimeout, name + ": the kernel does not tell of its interfaces");
  std::vector<std::byte> answer(1U << 15U);
  const ssize_t got = retry_interrupted([&] { return ::recv(fd.get(), answer.data(), answer.size(), 0); });
  if (got < 0) return fail_errno(name, "asking the kernel", errno);
  answer.resize(static_cast<std::size_t>(got));
  return answer;
}

bool is_bit_rate_of_profile(std::uint32_t bit_rate_bps) {
  return bit_rate_bps == 500'000 || bit_rate_bps == 250'000;
}

std::optional<CanComplaint> complaint_about_bus(const CanInterface& i, const std::string& name) {
  const std::string counted = i.errors ? " (" + to_text(*i.errors) + ")" : "";
  const std::string wiring =
      "look at plug, CAN-H and CAN-L, 120 Ohm at both ends, and the robot's bit rate; then ip link set " +
      name;
  if (i.state == CanState::kBusOff) {
    const bool by_itself = i.restart_ms.value_or(0) > 0;
    return CanComplaint{
        name + " is bus-off: too many errors, the controller took itself off the bus" + counted,
        wiring + (by_itself ? " down && ip link set " + name + " up"
                            : " type can restart; and for ever: ip link set " + name + " down && " +
                                  can_bring_up_command(name)),
        true};
  }
  // ISO 11898-1, 12.1.4.2: the counter of a transmitter without acknowledgement stops at error passive.
  const bool alone =
      i.state == CanState::kPassive && i.errors && i.errors->transmit >= 128 && i.errors->receive == 0;
  if (alone)
    return CanComplaint{
        "nobody on " + name + " acknowledges" + counted + ": no other device is on the bus",
        "switch the robot's CAN side on; " + wiring + " down && " + can_bring_up_command(name)};
  if (i.state == CanState::kPassive)
    return CanComplaint{name + " is error passive: most frames fail" + counted,
                        wiring + " down && " + can_bring_up_command(name)};
  return std::nullopt;
}

}  // namespace

CanInterface parse_link(Bytes message) {
  CanInterface interface;
  if (message.size() < NLMSG_LENGTH(sizeof(ifinfomsg))) return interface;
  nlmsghdr head{};
  ifinfomsg link{};
  std::memcpy(&head, message.data(), sizeof head);
  std::memcpy(&link, message.data() + NLMSG_HDRLEN, sizeof link);
  if (head.nlmsg_type != RTM_NEWLINK) return interface;
  interface.exists = true;
  interface.is_can = link.ifi_type == ARPHRD_CAN;
  interface.up = (link.ifi_flags & IFF_UP) != 0;
  for_each_attribute(message.subspan(NLMSG_LENGTH(sizeof link)), [&](unsigned type, Bytes content) {
    if (type == IFLA_TXQLEN) interface.queue_length = value_of<std::uint32_t>(content).value_or(0);
    if (type == IFLA_LINKINFO) take_link_info(interface, content);
  });
  return interface;
}

std::string can_bring_up_command(const std::string& name) {
  return "ip link set " + name +
         " txqueuelen 128 up type can bitrate 500000 sample-point 0.875 restart-ms 100 berr-reporting on";
}

Result<CanInterface> query_can_interface(const std::string& name) {
  if (name.size() >= IFNAMSIZ) return CanInterface{};
  const auto answer = ask(name);
  if (!answer) return tl::unexpected(answer.error());
  return parse_link(*answer);
}

std::optional<CanComplaint> complaint_about(const CanInterface& i, const std::string& name) {
  constexpr std::uint32_t kLongestTransfer = 30;  // frames of a packet of 207 bytes
  if (!i.exists)
    return CanComplaint{
        "there is no interface " + name,
        "plug the adapter in (ip -br link shows what is there), or mend base.address; without a "
        "bus: ip link add " +
            name + " type vcan && ip link set " + name + " up",
        true};
  if (!i.is_can)
    return CanComplaint{name + " is no CAN interface",
                        "mend base.address: ip -br link show type can names those", true};
  if (i.bit_rate_bps && !is_bit_rate_of_profile(*i.bit_rate_bps))
    return CanComplaint{name + " runs at " + std::to_string(*i.bit_rate_bps) +
                            " bit/s; expected 500000, or 250000 where the robot's CAN side is set to it",
                        "ip link set " + name + " down && " + can_bring_up_command(name)};
  if (!i.up)
    return CanComplaint{name + " is switched off",
                        i.is_virtual() ? "ip link set " + name + " up" : can_bring_up_command(name), true};
  if (auto bus = complaint_about_bus(i, name)) return bus;
  // A virtual interface has no queue.
  if (!i.is_virtual() && i.queue_length < kLongestTransfer)
    return CanComplaint{name + " queues only " + std::to_string(i.queue_length) +
                            " frames; one packet may have " + std::to_string(kLongestTransfer),
                        "ip link set " + name + " txqueuelen 128"};
  return std::nullopt;
}

}  // namespace topo::io
