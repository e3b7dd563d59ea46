// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/io/can_socket.hpp"

#include <linux/can.h>
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <linux/errqueue.h>
#include <linux/net_tstamp.h>
#include <net/if.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <ctime>
#include <utility>
#include <vector>

#include "core/types/invariant.hpp"
#include "drivers/io/posix.hpp"

namespace topo::io {
namespace {

using types::Duration;
using types::Errc;
using types::fail;
using types::Result;
using types::Stamp;
using types::Status;

/// Band 0 of the interface's queue (pfifo_fast), and the highest priority that needs no privilege.
constexpr int kFirstPriority = 6;

tl::unexpected<types::Error> fail_can(const std::string& name, std::string_view doing, int error) {
  types::Error failure = error_of_errno(name, doing, error);
  if (error == ENETDOWN || error == ENODEV || error == ENXIO) failure.code = Errc::kClosed;
  if (error == ENETDOWN) failure.message = name + ": the CAN interface was switched off";
  if (error == ENODEV || error == ENXIO) failure.message = name + ": the CAN interface is gone";
  return tl::unexpected<types::Error>(std::move(failure));
}

template <class Value>
Status set_option(const UniqueFd& fd, const std::string& name, int level, int option, const Value& value,
                  socklen_t size = sizeof(Value)) {
  if (::setsockopt(fd.get(), level, option, &value, size) == 0) return {};
  return fail_errno(name, "setting an option of the CAN socket", errno);
}

Result<UniqueFd> make_socket(const std::string& name) {
  UniqueFd fd(::socket(PF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW));
  if (fd.valid()) return fd;
  if (errno == EAFNOSUPPORT || errno == EPROTONOSUPPORT)
    return fail(Errc::kUnsupported,
                name +
                    ": this kernel has no CAN (modprobe can-raw; the \"cloud\" kernels of Debian are built "
                    "without it)");
  return fail_errno(name, "making a CAN socket", errno);
}

/// Set before bind(), so that the queue never holds other frames.
Status set_filters(const UniqueFd& fd, std::span<const std::uint16_t> ids, const std::string& name) {
  std::vector<can_filter> filters;
  for (const std::uint16_t id : ids) filters.push_back({id, CAN_SFF_MASK | CAN_EFF_FLAG | CAN_RTR_FLAG});
  if (::setsockopt(fd.get(), SOL_CAN_RAW, CAN_RAW_FILTER, filters.data(),
                   static_cast<socklen_t>(filters.size() * sizeof(can_filter))) == 0)
    return {};
  return fail_errno(name, "setting the filters of the CAN socket", errno);
}

Status bind_to(const UniqueFd& fd, unsigned interface, const std::string& name) {
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = static_cast<int>(interface);
  if (::bind(fd.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) return {};
  if (errno == ENODEV) return fail(Errc::kNotFound, name + ": this is no CAN interface", errno);
  return fail_can(name, "binding the CAN socket", errno);
}

Status set_up_data(const UniqueFd& fd, std::span<const std::uint16_t> ids, const std::string& name) {
  constexpr int kStamps = SOF_TIMESTAMPING_RX_SOFTWARE | SOF_TIMESTAMPING_SOFTWARE;
  constexpr can_err_mask_t kErrors = CAN_ERR_MASK;
  if (auto set = set_filters(fd, ids, name); !set) return set;
  if (auto set = set_option(fd, name, SOL_CAN_RAW, CAN_RAW_ERR_FILTER, kErrors); !set) return set;
  if (auto set = set_option(fd, name, SOL_SOCKET, SO_TIMESTAMPING, kStamps); !set) return set;
  return set_option(fd, name, SOL_SOCKET, SO_RXQ_OVFL, 1);
}

Status set_up_first(const UniqueFd& fd, const std::string& name) {
  if (auto set = set_filters(fd, {}, name); !set) return set;  // it only sends
  return set_option(fd, name, SOL_SOCKET, SO_PRIORITY, kFirstPriority);
}

Stamp steady_stamp(const timespec& real) {
  timespec now{};
  ::clock_gettime(CLOCK_REALTIME, &now);
  const Duration age =
      std::chrono::seconds(now.tv_sec - real.tv_sec) + std::chrono::nanoseconds(now.tv_nsec - real.tv_nsec);
  return can_arrival(monotonic_now(), age);
}

template <class Value>
Value value_in(const cmsghdr& header) {
  Value value{};
  std::memcpy(&value, CMSG_DATA(&header), sizeof value);
  return value;
}

}  // namespace

Stamp can_arrival(Stamp now, Duration age) {
  constexpr Duration kOldest = std::chrono::seconds(1);
  return now - std::clamp(age, Duration::zero(), kOldest);
}

Result<std::unique_ptr<CanPort>> CanSocket::open(const std::string& interface,
                                                 std::span<const std::uint16_t> ids, std::string name) {
  auto data = make_socket(name);
  if (!data) return tl::unexpected(data.error());
  auto first = make_socket(name);
  if (!first) return tl::unexpected(first.error());
  const unsigned index = ::if_nametoindex(interface.c_str());
  if (index == 0) return fail(Errc::kNotFound, name + ": there is no interface " + interface, errno);
  if (auto set = set_up_data(*data, ids, name); !set) return tl::unexpected(set.error());
  if (auto set = set_up_first(*first, name); !set) return tl::unexpected(set.error());
  if (auto bound = bind_to(*data, index, name); !bound) return tl::unexpected(bound.error());
  if (auto bound = bind_to(*first, index, name); !bound) return tl::unexpected(bound.error());
  return std::unique_ptr<CanPort>(new CanSocket(std::move(*data), std::move(*first), std::move(name)));
}

Result<CanEvent> CanSocket::receive(Duration timeout) {
  auto event = take();
  if (!event || !std::holds_alternative<std::monostate>(*event) || timeout <= Duration::zero()) return event;
  if (wait_for(data_.get(), POLLIN, timeout) < 0) return fail_can(name_, "waiting for frames", errno);
  return take();
}

Result<CanEvent> CanSocket::take() {
  can_frame frame{};
  iovec place{&frame, sizeof frame};
  alignas(cmsghdr) std::array<char, 256> control{};
  msghdr message{};
  message.msg_iov = &place;
  message.msg_iovlen = 1;
  message.msg_control = control.data();
  message.msg_controllen = control.size();
  const ssize_t got = retry_interrupted([&] { return ::recvmsg(data_.get(), &message, MSG_DONTWAIT); });
  if (got < 0 && errno == EAGAIN) return CanEvent{};
  if (got < 0) return fail_can(name_, "receiving", errno);
  Stamp stamp = monotonic_now();
  for (cmsghdr* part = CMSG_FIRSTHDR(&message); part != nullptr; part = CMSG_NXTHDR(&message, part)) {
    if (part->cmsg_level != SOL_SOCKET) continue;
    if (part->cmsg_type == SO_TIMESTAMPING) stamp = steady_stamp(value_in<scm_timestamping>(*part).ts[0]);
    if (part->cmsg_type == SO_RXQ_OVFL) dropped_ = value_in<std::uint32_t>(*part);
  }
  CanData data;
  data.size = std::min<std::uint8_t>(frame.can_dlc, CAN_MAX_DLEN);
  std::memcpy(data.bytes.data(), frame.data, data.size);
  if ((frame.can_id & CAN_ERR_FLAG) != 0) return CanEvent{decode_can_error(frame.can_id, data.view())};
  return CanEvent{CanFrame{static_cast<std::uint16_t>(frame.can_id & CAN_SFF_MASK), data, stamp}};
}

Status CanSocket::send_on(const UniqueFd& socket, std::uint16_t id, const CanData& data) const {
  can_frame frame{};
  frame.can_id = id;
  types::require(data.size <= sizeof frame.data, "io::CanSocket: more bytes than a frame carries");
  frame.can_dlc = data.size;
  std::memcpy(frame.data, data.bytes.data(), data.size);
  const ssize_t sent = retry_interrupted([&] { return ::write(socket.get(), &frame, sizeof frame); });
  if (sent >= 0) return {};
  if (errno == ENOBUFS || errno == EAGAIN) return fail(Errc::kBusy, "queue full");  // short: no allocation
  return fail_can(name_, "sending", errno);
}

Stamp CanSocket::now() const { return monotonic_now(); }

}  // namespace topo::io
