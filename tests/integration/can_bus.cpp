// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/integration/can_bus.hpp"

#include <linux/can.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <sstream>
#include <utility>

namespace topo::test {
namespace {

double seconds_of(const timespec& t) {
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

std::vector<CanPair> pairs_in(const char* variable) {
  const char* text = std::getenv(variable);
  std::istringstream words(text == nullptr ? "" : text);
  std::vector<CanPair> pairs;
  for (std::string word; words >> word;) {
    const auto colon = word.find(':');
    pairs.push_back({word.substr(0, colon), colon == std::string::npos ? word : word.substr(colon + 1)});
  }
  return pairs;
}

}  // namespace

double realtime_s() {
  timespec now{};
  ::clock_gettime(CLOCK_REALTIME, &now);
  return seconds_of(now);
}

std::vector<CanPair> can_pairs() { return pairs_in("TOPOMETRIC_CAN"); }
std::vector<CanPair> can_controllers() { return pairs_in("TOPOMETRIC_CAN_CONTROLLERS"); }

sim::RobotConfig light_can_robot(const std::string& interface) {
  sim::RobotConfig robot = sim::can_robot(interface);
  robot.front = robot.coronal = sim::ScipModel::kUrg04Lx;
  return robot;
}

CanBus::CanBus(const std::string& interface, std::uint32_t id, std::uint32_t mask) {
  sim::FileDescriptor socket(::socket(PF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW));
  const can_filter filter{id, mask};
  ::setsockopt(socket.get(), SOL_CAN_RAW, CAN_RAW_FILTER, &filter, sizeof filter);
  const int on = 1;
  ::setsockopt(socket.get(), SOL_SOCKET, SO_TIMESTAMPNS, &on, sizeof on);
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = static_cast<int>(::if_nametoindex(interface.c_str()));
  if (address.can_ifindex == 0) return;
  if (::bind(socket.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0)
    socket_ = std::move(socket);
}

bool CanBus::send(std::uint32_t id, const std::vector<std::uint8_t>& data) {
  can_frame frame{};
  frame.can_id = id;
  frame.can_dlc = static_cast<std::uint8_t>(std::min<std::size_t>(data.size(), CAN_MAX_DLEN));
  std::copy_n(data.begin(), frame.can_dlc, frame.data);
  return ::write(socket_.get(), &frame, sizeof frame) == static_cast<ssize_t>(sizeof frame);
}

std::optional<CanBus::Heard> CanBus::hear(double seconds) {
  pollfd entry{socket_.get(), POLLIN, 0};
  if (::poll(&entry, 1, static_cast<int>(seconds * 1e3)) <= 0) return std::nullopt;
  can_frame frame{};
  iovec place{&frame, sizeof frame};
  alignas(cmsghdr) std::array<char, 128> control{};
  msghdr message{};
  message.msg_iov = &place;
  message.msg_iovlen = 1;
  message.msg_control = control.data();
  message.msg_controllen = control.size();
  if (::recvmsg(socket_.get(), &message, 0) != static_cast<ssize_t>(sizeof frame)) return std::nullopt;
  Heard heard{
      frame.can_id, {frame.data, frame.data + std::min<int>(frame.can_dlc, CAN_MAX_DLEN)}, realtime_s()};
  for (cmsghdr* part = CMSG_FIRSTHDR(&message); part != nullptr; part = CMSG_NXTHDR(&message, part)) {
    if (part->cmsg_level != SOL_SOCKET || part->cmsg_type != SO_TIMESTAMPNS) continue;
    timespec stamp{};
    std::memcpy(&stamp, CMSG_DATA(part), sizeof stamp);
    heard.realtime_s = seconds_of(stamp);
  }
  return heard;
}

void CanBus::forget() {
  while (hear(0.0)) {
  }
}

}  // namespace topo::test
