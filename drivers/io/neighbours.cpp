// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/io/neighbours.hpp"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <net/if_arp.h>
#include <netinet/in.h>
#include <netpacket/packet.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <memory>
#include <sstream>

#include "drivers/io/posix.hpp"
#include "drivers/io/unique_fd.hpp"

namespace topo::io {
namespace {

using types::Errc;
using types::Result;

constexpr std::size_t kMac = 6, kIp = 4;
constexpr std::uint16_t kEtherArp = 0x0806, kEtherIp = 0x0800;

/// An ARP packet of Ethernet and IPv4 (RFC 826), as on the wire.
struct ArpPacket {
  std::array<std::uint8_t, 2> hardware{0, ARPHRD_ETHER};
  std::array<std::uint8_t, 2> protocol{kEtherIp >> 8U, kEtherIp & 0xFFU};
  std::uint8_t hardware_size = kMac, protocol_size = kIp;
  std::array<std::uint8_t, 2> operation{0, ARPOP_REQUEST};
  std::array<std::uint8_t, kMac> sender_mac{};
  std::array<std::uint8_t, kIp> sender_ip{};
  std::array<std::uint8_t, kMac> target_mac{};
  std::array<std::uint8_t, kIp> target_ip{};
};
static_assert(sizeof(ArpPacket) == 28, "as on the wire");

std::string mac_text(const std::array<std::uint8_t, kMac>& mac) {
  std::array<char, 18> text{};
  std::snprintf(text.data(), text.size(), "%02x:%02x:%02x:%02x:%02x:%02x", mac[0], mac[1], mac[2], mac[3],
                mac[4], mac[5]);
  return text.data();
}

/// An interface that the address is reached by, and its own address there.
struct Interface {
  std::string name;
  unsigned index = 0;
  in_addr own{};
};

struct AddressesDelete {
  void operator()(ifaddrs* list) const { ::freeifaddrs(list); }
};

in_addr ip_of(const sockaddr* address) {
  sockaddr_in copy{};
  std::memcpy(&copy, address, sizeof copy);
  return copy.sin_addr;
}

std::vector<Interface> interfaces_to(in_addr wanted) {
  ifaddrs* raw = nullptr;
  std::vector<Interface> out;
  if (::getifaddrs(&raw) != 0) return out;
  const std::unique_ptr<ifaddrs, AddressesDelete> list(raw);
  for (const ifaddrs* i = raw; i != nullptr; i = i->ifa_next) {
    const bool usable = i->ifa_addr != nullptr && i->ifa_netmask != nullptr &&
                        i->ifa_addr->sa_family == AF_INET && (i->ifa_flags & IFF_UP) != 0 &&
                        (i->ifa_flags & (IFF_LOOPBACK | IFF_NOARP)) == 0;
    if (!usable) continue;
    const in_addr own = ip_of(i->ifa_addr), mask = ip_of(i->ifa_netmask);
    if (((own.s_addr ^ wanted.s_addr) & mask.s_addr) != 0) continue;
    out.push_back({i->ifa_name, ::if_nametoindex(i->ifa_name), own});
  }
  return out;
}

/// Whoever answers on one interface.
Result<std::vector<Neighbour>> ask_on(const Interface& interface, in_addr wanted, const std::string& address,
                                      types::Duration patience) {
  const UniqueFd fd(::socket(AF_PACKET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, htons(kEtherArp)));
  if (!fd.valid()) return fail_errno(interface.name, "opening a socket for ARP", errno);
  ifreq request{};
  std::snprintf(request.ifr_name, sizeof request.ifr_name, "%s", interface.name.c_str());
  if (::ioctl(fd.get(), SIOCGIFHWADDR, &request) != 0)
    return fail_errno(interface.name, "reading its MAC", errno);
  ArpPacket packet;
  std::memcpy(packet.sender_mac.data(), request.ifr_hwaddr.sa_data, kMac);
  std::memcpy(packet.sender_ip.data(), &interface.own, kIp);
  std::memcpy(packet.target_ip.data(), &wanted, kIp);
  sockaddr_ll to{};
  to.sll_family = AF_PACKET;
  to.sll_protocol = htons(kEtherArp);
  to.sll_ifindex = static_cast<int>(interface.index);
  to.sll_halen = kMac;
  std::fill_n(static_cast<std::uint8_t*>(to.sll_addr), kMac, std::uint8_t{0xFF});
  if (::bind(fd.get(), reinterpret_cast<const sockaddr*>(&to), sizeof to) != 0 ||
      ::sendto(fd.get(), &packet, sizeof packet, 0, reinterpret_cast<const sockaddr*>(&to), sizeof to) < 0)
    return fail_errno(interface.name, "asking by ARP", errno);
  std::vector<Neighbour> out;
  const types::Stamp end = monotonic_now() + patience;
  std::array<std::uint8_t, 256> bytes{};
  for (types::Stamp now = monotonic_now(); now < end; now = monotonic_now()) {
    if (wait_for(fd.get(), POLLIN, end - now) <= 0) continue;
    const ssize_t got = ::recv(fd.get(), bytes.data(), bytes.size(), 0);
    if (got <= 0) continue;
    const auto mac = arp_sender({bytes.data(), static_cast<std::size_t>(got)}, address);
    if (!mac) continue;
    const Neighbour found{address, *mac, interface.name};
    if (std::find(out.begin(), out.end(), found) == out.end()) out.push_back(found);
  }
  return out;
}

}  // namespace

std::vector<Neighbour> parse_neighbour_table(std::string_view text) {
  constexpr unsigned kComplete = 0x2;  // ATF_COM
  std::vector<Neighbour> out;
  std::istringstream lines{std::string(text)};
  std::string line;
  std::getline(lines, line);  // names of the columns
  while (std::getline(lines, line)) {
    std::istringstream words(line);
    std::string address, type, mac, mask, interface;
    unsigned flags = 0;
    if (!(words >> address >> type >> std::hex >> flags >> mac >> mask >> interface)) continue;
    if ((flags & kComplete) != 0) out.push_back({address, mac, interface});
  }
  return out;
}

std::optional<std::string> arp_sender(std::span<const std::uint8_t> payload, const std::string& address) {
  ArpPacket packet;
  if (payload.size() < sizeof packet) return std::nullopt;
  std::memcpy(&packet, payload.data(), sizeof packet);
  const ArpPacket form;
  if (packet.hardware != form.hardware || packet.protocol != form.protocol || packet.hardware_size != kMac ||
      packet.protocol_size != kIp || packet.operation != std::array<std::uint8_t, 2>{0, ARPOP_REPLY})
    return std::nullopt;
  std::array<char, INET_ADDRSTRLEN> sender{};
  ::inet_ntop(AF_INET, packet.sender_ip.data(), sender.data(), sender.size());
  if (address != sender.data()) return std::nullopt;
  return mac_text(packet.sender_mac);
}

Result<std::vector<Neighbour>> ask_neighbours(const std::string& address, types::Duration patience) {
  in_addr wanted{};
  if (::inet_pton(AF_INET, address.c_str(), &wanted) != 1)
    return types::fail(Errc::kInvalidInput,
                       "found \"" + address + "\", expected an IPv4 address such as 192.168.0.10");
  std::vector<Neighbour> out;
  for (const Interface& interface : interfaces_to(wanted)) {
    auto found = ask_on(interface, wanted, address, patience);
    if (!found) return found;
    out.insert(out.end(), found->begin(), found->end());
  }
  return out;
}

std::vector<Neighbour> known_neighbours() {
  std::ifstream file("/proc/net/arp");
  return parse_neighbour_table(std::string(std::istreambuf_iterator<char>(file), {}));
}

}  // namespace topo::io
