// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace topo::daemon {

/// What the radio is made with.
struct RadioPlan {
  std::string interface;           ///< its name
  std::string address;             ///< its IPv4 address
  bool multicast = false;          ///< the interface carries it
  std::vector<std::string> peers;  ///< IPv4 addresses; empty: found by multicast
  std::uint32_t domain = 0;
  std::uint64_t team = 0;
  std::uint16_t robot = 0;  ///< in whose partition it writes
  std::string security;     ///< folder of the credentials; empty: off
};

/// Multicast group of a team's data: 239.192.0.0/16 (organisation-local, RFC 2365) and 16 bits of the team's
/// hash, so that the radio's receiver drops most of what other teams send.
[[nodiscard]] std::string team_group(std::uint64_t team);

/// The configuration of Cyclone DDS for `plan`, XML. `plugins`: folder of its security plugins.
[[nodiscard]] std::string cyclone_config(const RadioPlan& plan, const std::string& plugins);

}  // namespace topo::daemon
