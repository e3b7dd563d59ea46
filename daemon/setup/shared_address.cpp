// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/setup/shared_address.hpp"

#include <fmt/format.h>

#include <set>
#include <vector>

namespace topo::daemon {

std::string shared_address(const std::string& address, std::span<const io::Neighbour> neighbours) {
  std::set<std::string> seen;
  std::vector<std::string> devices;
  for (const io::Neighbour& n : neighbours)
    if (n.address == address && seen.insert(n.mac).second)
      devices.push_back(fmt::format("{} on {}", n.mac, n.interface));
  if (devices.size() < 2) return {};
  return fmt::format(
      "{} devices answer at {}: {}. Two scanners from the factory have one address: unplug all but one, say "
      "topoctl laser set-ip {} NEW, switch its power off and on, and plug the others in",
      devices.size(), address, fmt::join(devices, ", "), address);
}

}  // namespace topo::daemon
