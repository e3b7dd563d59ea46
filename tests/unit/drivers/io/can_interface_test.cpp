// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/io/can_interface.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/can/netlink.h>
#include <linux/rtnetlink.h>
#include <net/if.h>
#include <net/if_arp.h>

#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace topo::io {
namespace {

using testing::HasSubstr;
using Bytes = std::vector<std::byte>;

template <class Value>
void append(Bytes& bytes, const Value& value) {
  const auto* first = reinterpret_cast<const std::byte*>(&value);
  bytes.insert(bytes.end(), first, first + sizeof value);
}

/// A chain of attributes as the kernel lays it out.
Bytes attribute(unsigned short type, const Bytes& content) {
  Bytes bytes;
  append(bytes, rtattr{static_cast<unsigned short>(RTA_LENGTH(content.size())), type});
  bytes.insert(bytes.end(), content.begin(), content.end());
  bytes.resize(RTA_ALIGN(bytes.size()));
  return bytes;
}
template <class Value>
Bytes attribute_of(unsigned short type, const Value& value) {
  Bytes content;
  append(content, value);
  return attribute(type, content);
}
Bytes operator+(Bytes a, const Bytes& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

Bytes link_message(unsigned short hardware, unsigned flags, const Bytes& attributes) {
  ifinfomsg link{};
  link.ifi_type = hardware;
  link.ifi_flags = flags;
  Bytes body;
  append(body, link);
  nlmsghdr head{};
  head.nlmsg_type = RTM_NEWLINK;
  head.nlmsg_len = static_cast<std::uint32_t>(NLMSG_LENGTH(body.size() + attributes.size()));
  Bytes message;
  append(message, head);
  return message + body + attributes;
}

/// can0 as a controller of an adapter shows it. The kernel leaves the bit rate out while it was never set.
Bytes real_can(std::uint32_t bit_rate, std::uint32_t state, can_berr_counter errors,
               std::uint32_t restart_ms) {
  can_bittiming timing{};
  timing.bitrate = bit_rate;
  const Bytes known_timing = bit_rate == 0 ? Bytes{} : attribute_of(IFLA_CAN_BITTIMING, timing);
  const Bytes data = known_timing + attribute_of(IFLA_CAN_STATE, state) +
                     attribute_of(IFLA_CAN_BERR_COUNTER, errors) +
                     attribute_of(IFLA_CAN_RESTART_MS, restart_ms);
  const Bytes kind{std::byte{'c'}, std::byte{'a'}, std::byte{'n'}, std::byte{0}};
  const Bytes info = attribute(IFLA_INFO_KIND, kind) + attribute(IFLA_INFO_DATA | 0x8000, data);
  return link_message(ARPHRD_CAN, IFF_UP, attribute_of(IFLA_TXQLEN, 128U) + attribute(IFLA_LINKINFO, info));
}

CanInterface sound() { return parse_link(real_can(500'000, CAN_STATE_ERROR_ACTIVE, {}, 100)); }

TEST(CanInterface, IsReadFromTheKernelsAnswer) {
  const CanInterface i = parse_link(real_can(250'000, CAN_STATE_ERROR_PASSIVE, {130, 5}, 100));
  EXPECT_TRUE(i.exists && i.is_can && i.up);
  EXPECT_EQ(i.queue_length, 128U);
  EXPECT_EQ(i.bit_rate_bps, 250'000U);
  EXPECT_EQ(i.restart_ms, 100U);
  EXPECT_EQ(i.state, CanState::kPassive);
  EXPECT_EQ(i.errors, (CanErrorCounters{130, 5}));
  EXPECT_EQ(parse_link(real_can(250'000, 3, {300, 0}, 0)).errors, (CanErrorCounters{255, 0}));
}

TEST(CanInterface, AnAnswerCutAnywhereIsNoTrap) {
  const Bytes whole = real_can(500'000, CAN_STATE_BUS_OFF, {255, 0}, 0);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    // In storage of its own, so that a sanitizer sees a read beyond it.
    const Bytes cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
    EXPECT_EQ(parse_link(cut).exists, size >= NLMSG_LENGTH(sizeof(ifinfomsg)));
  }
}

TEST(CanInterface, TheKernelIsAsked) {
  const auto loopback = query_can_interface("lo");
  ASSERT_TRUE(loopback) << loopback.error().message;
  EXPECT_TRUE(loopback->exists);
  EXPECT_FALSE(loopback->is_can);
  const auto none = query_can_interface("no-such-can");
  ASSERT_TRUE(none) << none.error().message;
  EXPECT_FALSE(none->exists);
  EXPECT_FALSE(query_can_interface("a-name-that-is-too-long-for-linux")->exists);
}

TEST(CanComplaint, ASoundInterfaceHasNone) {
  EXPECT_FALSE(complaint_about(sound(), "can0"));
  CanInterface slow = sound();
  slow.bit_rate_bps = 250'000;
  EXPECT_FALSE(complaint_about(slow, "can0"));
  CanInterface virtual_bus;
  virtual_bus.exists = virtual_bus.is_can = virtual_bus.up = true;
  EXPECT_FALSE(complaint_about(virtual_bus, "vcan0"));
}

// What `ip link set can0 up` alone does then: RTNETLINK answers: Invalid argument.
TEST(CanComplaint, AControllerWhoseBitRateWasNeverSetIsNoVirtualBus) {
  CanInterface fresh = parse_link(real_can(0, CAN_STATE_STOPPED, {}, 0));
  EXPECT_FALSE(fresh.bit_rate_bps);
  EXPECT_FALSE(fresh.is_virtual());
  fresh.up = false;
  const auto complaint = complaint_about(fresh, "can0");
  ASSERT_TRUE(complaint);
  EXPECT_EQ(complaint->cure, can_bring_up_command("can0"));
}

// One command everywhere.
TEST(CanBringUp, StandsInTheDocumentsAsTheDoctorSaysIt) {
  const char* source = std::getenv("TOPOMETRIC_SOURCE");
  ASSERT_NE(source, nullptr) << "set TOPOMETRIC_SOURCE to the source folder, as ctest does";
  const auto text_of = [source](const std::string& name) {
    std::ostringstream text;
    text << std::ifstream(std::string(source) + "/" + name).rdbuf();
    return text.str();
  };
  EXPECT_THAT(text_of("config/p3dx-can.toml"), HasSubstr("\n#   " + can_bring_up_command("can0") + "\n"));
  EXPECT_THAT(text_of("systemd/80-topometric-can.network"),
              HasSubstr("\n#   " + can_bring_up_command("can0") + "\n"));
  EXPECT_THAT(text_of("tests/vm/can_test.py"), HasSubstr(can_bring_up_command("$c")));
}

struct Case {
  const char* what;
  void (*spoil)(CanInterface&);
  const char* found;
  const char* cure;
  bool blocks;
};

class CanComplaintOf : public testing::TestWithParam<Case> {};

TEST_P(CanComplaintOf, NamesTheFaultAndTheCommandThatCuresIt) {
  CanInterface i = sound();
  GetParam().spoil(i);
  const auto complaint = complaint_about(i, "can0");
  ASSERT_TRUE(complaint);
  EXPECT_THAT(complaint->found, HasSubstr(GetParam().found));
  EXPECT_THAT(complaint->cure, HasSubstr(GetParam().cure));
  EXPECT_EQ(complaint->blocks, GetParam().blocks);
}

INSTANTIATE_TEST_SUITE_P(
    Faults, CanComplaintOf,
    testing::Values(
        Case{"Missing", [](CanInterface& i) { i = {}; }, "there is no interface can0", "ip -br link", true},
        Case{"NoCan", [](CanInterface& i) { i.is_can = false; }, "no CAN interface", "base.address", true},
        Case{"Down", [](CanInterface& i) { i.up = false; }, "switched off",
             "ip link set can0 txqueuelen 128 up type can bitrate 500000 sample-point 0.875 restart-ms 100 "
             "berr-reporting on",
             true},
        Case{"NeverSetUp",
             [](CanInterface& i) {
               i.up = false;
               i.bit_rate_bps.reset();
             },
             "switched off", "ip link set can0 txqueuelen 128 up type can bitrate 500000", true},
        Case{"BitRate", [](CanInterface& i) { i.bit_rate_bps = 125'000; }, "runs at 125000 bit/s",
             "ip link set can0 down && ip link set can0 txqueuelen 128 up type can", false},
        Case{"BusOff",
             [](CanInterface& i) {
               i.state = CanState::kBusOff;
               i.restart_ms = 0;
             },
             "bus-off", "ip link set can0 type can restart", true},
        Case{"BusOffForAMoment", [](CanInterface& i) { i.state = CanState::kBusOff; }, "bus-off",
             "ip link set can0 down && ip link set can0 up", true},
        Case{"Alone",
             [](CanInterface& i) {
               i.state = CanState::kPassive;
               i.errors = CanErrorCounters{128, 0};
             },
             "nobody on can0 acknowledges",
             "ip link set can0 down && ip link set can0 txqueuelen 128 up type can", false},
        Case{"Passive",
             [](CanInterface& i) {
               i.state = CanState::kPassive;
               i.errors = CanErrorCounters{140, 90};
             },
             "error passive", "ip link set can0 down", false},
        Case{"ShortQueue", [](CanInterface& i) { i.queue_length = 10; }, "queues only 10 frames",
             "ip link set can0 txqueuelen 128", false}),
    [](const auto& a_case) { return std::string(a_case.param.what); });

}  // namespace
}  // namespace topo::io
