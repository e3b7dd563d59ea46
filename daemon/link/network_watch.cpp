// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/link/network_watch.hpp"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <linux/rtnetlink.h>
#include <net/if.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <memory>

#include "drivers/io/posix.hpp"

namespace topo::daemon {
namespace {

struct FreeAddresses {
  void operator()(ifaddrs* all) const { ::freeifaddrs(all); }
};

}  // namespace

std::optional<NetworkAddress> network_address(const std::string& interface) {
  ifaddrs* list = nullptr;
  if (::getifaddrs(&list) != 0) return {};
  const std::unique_ptr<ifaddrs, FreeAddresses> all(list);
  for (const ifaddrs* entry = all.get(); entry != nullptr; entry = entry->ifa_next) {
    const bool usable = entry->ifa_addr != nullptr && entry->ifa_addr->sa_family == AF_INET &&
                        (entry->ifa_flags & IFF_UP) != 0 && interface == entry->ifa_name;
    if (!usable) continue;
    sockaddr_in address{};
    std::memcpy(&address, entry->ifa_addr, sizeof address);
    std::array<char, INET_ADDRSTRLEN> text{};
    ::inet_ntop(AF_INET, &address.sin_addr, text.data(), text.size());
    return NetworkAddress{::if_nametoindex(entry->ifa_name), text.data(),
                          (entry->ifa_flags & IFF_MULTICAST) != 0};
  }
  return {};
}

types::Result<NetworkWatch> NetworkWatch::open() {
  io::UniqueFd fd(::socket(AF_NETLINK, SOCK_RAW | SOCK_CLOEXEC | SOCK_NONBLOCK, NETLINK_ROUTE));
  sockaddr_nl address{};
  address.nl_family = AF_NETLINK;
  address.nl_groups = RTMGRP_LINK | RTMGRP_IPV4_IFADDR;
  if (!fd.valid() || ::bind(fd.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
    return io::fail_errno("network interfaces", "the kernel does not tell of changes", errno);
  return NetworkWatch(std::move(fd));
}

bool NetworkWatch::drain() {
  std::array<std::byte, 8192> buffer{};
  bool changed = false;
  for (;;) {
    const ssize_t got =
        io::retry_interrupted([&] { return ::recv(fd_.get(), buffer.data(), buffer.size(), 0); });
    // ENOBUFS: messages were lost; that there were some is all that matters.
    if (got < 0 && errno != ENOBUFS) return changed;
    changed = true;
  }
}

}  // namespace topo::daemon
