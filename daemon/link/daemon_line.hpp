// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>

#include "core/types/stamp.hpp"
#include "daemon/link/link_channel.hpp"
#include "daemon/link/link_wire.hpp"

namespace topo::daemon {

/// The link's end of the socket: connects to the daemon, again once a second while there is none. No call
/// waits longer than a daemon takes that accepts nobody: 100 ms. For one thread.
class DaemonLine {
 public:
  /// `greeted`: a connected socket on which the greetings were exchanged, of before the link began anew; -1:
  /// none.
  DaemonLine(std::string path, const LinkIdentity& own, int greeted = -1);

  using Take = std::function<void(std::span<const std::byte>)>;
  /// Connects when it is time, takes the daemon's datagrams; `wrong_size` counts messages that are none.
  /// Returns words for the log when something changed, the same words once.
  [[nodiscard]] std::optional<std::string> turn(types::Stamp now, const Take& take,
                                                std::uint64_t& wrong_size);

  /// A datagram that the robot with number `sender` sent.
  LinkChannel::Sent send(std::uint16_t sender, std::span<const std::byte> datagram);
  void send_stats(const LinkStats& stats);

  [[nodiscard]] bool joined() const { return channel_ && channel_->state() == LinkChannel::State::kOpen; }
  /// The connected socket; -1: none.
  [[nodiscard]] int fd() const { return channel_ ? channel_->fd() : -1; }

 private:
  std::optional<std::string> told(std::string words);
  std::optional<std::string> connect(types::Stamp now);

  std::string path_;
  LinkIdentity own_;
  std::optional<LinkChannel> channel_;
  types::Stamp next_try_{};
  bool told_joined_ = false;
  std::string told_;
};

}  // namespace topo::daemon
