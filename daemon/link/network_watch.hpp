// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "core/types/result.hpp"
#include "drivers/io/unique_fd.hpp"

namespace topo::daemon {

/// A network interface that is switched on and has an IPv4 address. DDS chooses its interface when its
/// participant is made; when any of this changes, the participant must be made anew.
struct NetworkAddress {
  unsigned index = 0;   ///< the kernel's; another one when the interface went and came
  std::string address;  ///< the first
  bool multicast = false;
  friend bool operator==(const NetworkAddress&, const NetworkAddress&) = default;
};

/// The interface's state now; nothing while it is absent, switched off, or without an IPv4 address. That it
/// has no carrier does not matter: a radio loses that in every shadow.
[[nodiscard]] std::optional<NetworkAddress> network_address(const std::string& interface);

/// Whether interfaces or addresses changed (rtnetlink(7)); needs no privilege.
class NetworkWatch {
 public:
  static types::Result<NetworkWatch> open();
  [[nodiscard]] int fd() const { return fd_.get(); }
  /// Takes what the kernel said. True when something may have changed.
  [[nodiscard]] bool drain();

 private:
  explicit NetworkWatch(io::UniqueFd fd) : fd_(std::move(fd)) {}
  io::UniqueFd fd_;
};

}  // namespace topo::daemon
