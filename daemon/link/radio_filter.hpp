// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "daemon/link/link_wire.hpp"

namespace topo::daemon {

/// Of datagram.idl and how it is used: since 2 a robot writes in its partition. Robots of two versions do not
/// hear one another; the newer one says so.
inline constexpr std::uint16_t kRadioVersion = 2;
/// Numbers of robots, as in the configuration.
inline constexpr std::uint16_t kRobotMax = 250;

/// DDS partition in which a robot writes, as its permissions name it (topometric-team): "robot-7".
[[nodiscard]] std::string robot_partition(std::uint16_t robot);
/// The number in the name of a partition; 0 when it is none of a robot.
[[nodiscard]] std::uint16_t robot_of_partition(std::string_view partition);

/// What stands before the content of a datagram of the radio.
struct RadioHead {
  std::uint16_t version = kRadioVersion;
  std::uint16_t robot = 0;
  std::uint64_t team = 0;
  std::uint64_t run = 0;
  std::uint64_t number = 0;
  std::uint16_t writer = 0;  ///< robot whose partition it came in, by DDS and not by the sender's word
};

/// Numbers that were received: the newest, and which of the 64 before it.
class ReplayWindow {
 public:
  /// True when `number` is new; it counts as received then. A number older than the window counts as
  /// received.
  [[nodiscard]] bool take(std::uint64_t number);

 private:
  std::uint64_t newest_ = 0;
  std::uint64_t before_ = 0;  // bit i: newest_ - 1 - i was received
};

/// Decides which datagrams of the radio reach the daemon. Its memory is bounded by the number of robots. No
/// I/O.
class RadioFilter {
 public:
  RadioFilter(const LinkIdentity& own, std::uint64_t run) : own_(own), run_(run) {}

  /// Why the datagram is dropped; nothing when it goes to the daemon.
  [[nodiscard]] std::optional<LinkDrop> refuse(const RadioHead& head, std::size_t content_bytes);

 private:
  struct Mate {
    std::uint64_t run = 0;
    ReplayWindow received;
  };
  LinkIdentity own_;
  std::uint64_t run_;
  std::array<Mate, kRobotMax + 1U> mates_{};  // by number; a new run of a robot begins anew
};

}  // namespace topo::daemon
