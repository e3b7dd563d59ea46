// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "drivers/io/byte_stream.hpp"
#include "drivers/pioneer/arcos_codec.hpp"
#include "drivers/pioneer/connection.hpp"
#include "drivers/pioneer/outbox.hpp"

namespace topo::pioneer {

/// One open stream with ARCOS on it: packets in, paced commands out. Does not allocate after construction.
class Link {
 public:
  Link(std::unique_ptr<io::ByteStream> stream, Counters& counters);

  [[nodiscard]] types::Stamp now() const { return stream_->now(); }
  [[nodiscard]] Outbox& outbox() { return outbox_; }
  [[nodiscard]] bool has_baud() const { return stream_->has_baud(); }

  /// Sends the next command if one waits and its time has come. While another is still under way only a stop
  /// is sent, and at once: that one is given up, so the controller gets no two commands within the spacing.
  /// STOP goes out in this way where a setpoint is under way and a standstill waits, which follows it.
  types::Status pump();
  /// Past the queue and the spacing: for a last word before the line is given up. E_STOP waits for nothing,
  /// others for what is under way, 100 ms at most; what comes meanwhile is not heard.
  types::Status send_at_once(const CommandPacket& packet);
  /// Forgets what waits, and what is under way: a stop that ends it does not bring it back.
  void clear();
  /// All that was to be sent is out.
  [[nodiscard]] bool all_sent() const { return outbox_.empty() && stream_->ready(); }
  /// When pump() has something to do; far in the future when nothing waits, or while a command is still under
  /// way: receive() returns at its end.
  [[nodiscard]] types::Stamp next_send() const;
  /// When the last command went out; the connection's start before the first.
  [[nodiscard]] types::Stamp last_send() const { return last_send_; }

  /// Reads, unless bytes are still waiting to be parsed. Blocks at most `timeout`.
  types::Status receive(types::Duration timeout);
  /// When the last real read began: what came before that has been seen.
  [[nodiscard]] types::Stamp last_read() const { return last_read_; }
  std::optional<PacketView> next_packet();

  /// Also forgets half a packet and what was heard.
  types::Status set_baud(int baud);
  [[nodiscard]] types::Duration wire_time(std::size_t bytes) const;

  /// First bytes heard at this speed, for a message: text if it is text, hexadecimal otherwise. Allocates.
  [[nodiscard]] std::string heard() const;
  [[nodiscard]] bool heard_anything() const { return heard_size_ > 0; }

 private:
  static constexpr types::Duration kSpacing = std::chrono::milliseconds(4);
  static constexpr types::Duration kWriteTimeout = std::chrono::milliseconds(50);
  static constexpr types::Duration kFinishTime = std::chrono::milliseconds(100);

  types::Status send_next();
  types::Status send(const CommandPacket& packet);
  types::Status interrupt_with(const CommandPacket& stop);
  types::Status finish_transfer();
  void count_bad_packets();
  void count_bus_faults();

  std::unique_ptr<io::ByteStream> stream_;
  Counters& counters_;
  Outbox outbox_;
  std::optional<CommandPacket> last_;  ///< that was taken out of it, unless it was a stop
  PacketParser parser_;
  int baud_ = 0;  ///< 0: the line has no speed
  types::Stamp last_send_;
  types::Stamp send_after_;
  types::Stamp last_read_;
  std::array<std::byte, 2048> buffer_{};
  std::span<const std::byte> pending_;
  types::Stamp pending_stamp_{};
  std::array<std::byte, 24> heard_{};
  std::size_t heard_size_ = 0;
  std::uint64_t bad_before_ = 0;
  io::BusFaults bus_before_;
};

}  // namespace topo::pioneer
