// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>

#include "core/types/bytes.hpp"
#include "daemon/link/link_wire.hpp"
#include "drivers/io/unique_fd.hpp"
#include "drivers/io/unix_socket.hpp"

namespace topo::daemon {

inline constexpr io::SocketKind kLinkSocketKind{SOCK_SEQPACKET, "link socket"};

/// One connected packet socket between a daemon and its link; the same at both ends. No call ever waits.
class LinkChannel {
 public:
  enum class State {
    kGreeting,  ///< the other end has not greeted
    kOpen,
    kClosed,  ///< why() says why; for good
  };
  enum class Sent { kYes, kFull, kClosed };
  static constexpr std::size_t kKindBytes = 1;                ///< before what a message carries
  static constexpr std::size_t kHeardBytes = kKindBytes + 2;  ///< the same of a kHeard
  struct Packet {
    std::span<const std::byte> bytes;  ///< with the kind; good until the next call of next()
    [[nodiscard]] LinkMessage kind() const { return static_cast<LinkMessage>(bytes[0]); }
    [[nodiscard]] std::span<const std::byte> content() const { return bytes.subspan(1); }
    /// Of a length that may be handed on.
    [[nodiscard]] bool is_datagram() const { return is_carrying(LinkMessage::kDatagram, kKindBytes); }
    [[nodiscard]] bool is_heard() const { return is_carrying(LinkMessage::kHeard, kHeardBytes); }
    /// Of a kHeard: the number of the robot that sent it, and its datagram.
    [[nodiscard]] std::uint16_t sender() const { return types::load_le<std::uint16_t>(bytes, kKindBytes); }
    [[nodiscard]] std::span<const std::byte> datagram() const { return bytes.subspan(kHeardBytes); }

   private:
    [[nodiscard]] bool is_carrying(LinkMessage what, std::size_t head_bytes) const {
      return kind() == what && bytes.size() > head_bytes && bytes.size() <= head_bytes + kDatagramMax_bytes;
    }
  };

  /// Takes a connected socket and greets. `greeted`: the greetings were exchanged before (the link begins
  /// anew with the same socket).
  LinkChannel(io::UniqueFd socket, const LinkIdentity& own, bool greeted = false);

  /// The next message after the greeting; nothing when none is there or the channel is closed. A greeting
  /// that does not fit is refused: the words are sent, and the channel is closed.
  [[nodiscard]] std::optional<Packet> next();

  /// A datagram of at most kDatagramMax_bytes; a longer one is never sent.
  Sent send_datagram(std::span<const std::byte> datagram);
  /// The same of a datagram that the robot with number `sender` sent.
  Sent send_heard(std::uint16_t sender, std::span<const std::byte> datagram);
  /// A message with its kind, from encode_...().
  Sent send(std::span<const std::byte> message);

  [[nodiscard]] State state() const { return state_; }
  /// Empty while the channel is not closed.
  [[nodiscard]] const std::string& why() const { return why_; }
  /// True when it was refused, by this end or the other.
  [[nodiscard]] bool refused() const { return refused_; }
  [[nodiscard]] int fd() const { return socket_.get(); }

 private:
  void close(std::string why);
  void refuse(const std::string& words);
  /// A packet's bytes; nothing when none is there or the socket is closed.
  std::optional<std::span<const std::byte>> read();
  bool greeted_by(std::span<const std::byte> packet);

  io::UniqueFd socket_;
  LinkIdentity own_;
  State state_ = State::kGreeting;
  std::string why_;
  bool refused_ = false;
  std::array<std::byte, 2048> buffer_{};  // longer than every message; a longer packet is cut, and refused
};

}  // namespace topo::daemon
