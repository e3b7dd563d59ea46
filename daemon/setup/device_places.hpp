// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace topo::daemon {

/// Where devices are looked for.
struct SearchPlaces {
  /// Patterns of glob(7). A device with several names is called by the first: those of the socket before
  /// those that go by who was plugged in first.
  std::vector<std::string> serial{"/dev/topometric/*", "/dev/serial/by-id/*", "/dev/ttyUSB*", "/dev/ttyACM*",
                                  "/dev/ttyS[0-3]"};
  /// Hosts, or HOST:PORT: the factory's address, and those beside it that `laser set-ip` was shown to take.
  std::vector<std::string> tcp{"192.168.0.10", "192.168.0.11", "192.168.0.12"};
  std::vector<std::string> bases;  ///< further addresses at which only a base is looked for
  std::filesystem::path network_interfaces = "/sys/class/net";  ///< for CAN; empty: none
};

/// One address, in the form of the configuration.
struct SearchPlace {
  std::string address;
  bool base_only = false;  ///< no scanner can be there
  friend bool operator==(const SearchPlace&, const SearchPlace&) = default;
};

/// Every address to look at, each device once.
[[nodiscard]] std::vector<SearchPlace> addresses_of(const SearchPlaces& places);

}  // namespace topo::daemon
