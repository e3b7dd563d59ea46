// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/types/result.hpp"
#include "core/types/stamp.hpp"

namespace topo::io {

/// A device on an Ethernet network, by the answer that it gives for an IPv4 address.
struct Neighbour {
  std::string address;    ///< "192.168.0.10"
  std::string mac;        ///< "00:1d:48:00:00:01"
  std::string interface;  ///< "eth0"
  friend bool operator==(const Neighbour&, const Neighbour&) = default;
};

/// The complete entries of the kernel's neighbour table, from the text of /proc/net/arp. It holds one MAC for
/// an address on each interface.
[[nodiscard]] std::vector<Neighbour> parse_neighbour_table(std::string_view text);

/// The sender of an ARP reply (RFC 826) for `address`, from an Ethernet frame's payload; nothing for all
/// else.
[[nodiscard]] std::optional<std::string> arp_sender(std::span<const std::uint8_t> payload,
                                                    const std::string& address);

/// All that answer for an IPv4 address: asks by ARP on every Ethernet interface whose network holds it, and
/// listens for `patience`. kPermission without the right to (CAP_NET_RAW), kInvalidInput for no address.
[[nodiscard]] types::Result<std::vector<Neighbour>> ask_neighbours(const std::string& address,
                                                                   types::Duration patience);

/// The kernel's neighbour table; empty where there is none.
[[nodiscard]] std::vector<Neighbour> known_neighbours();

}  // namespace topo::io
