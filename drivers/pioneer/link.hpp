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

/// An open ARCOS stream: packets in, paced commands out. Does not allocate after construction.
class Link {
 public:
  Link(std::unique_ptr<io::ByteStream> stream, Counters& counters);

  [[nodiscard]] types::Stamp now() const { return stream_->now(); }
  [[nodiscard]] Outbox& outbox() { return outbox_; }
  [[nodiscard]] bool has_baud() const { return stream_->has_baud(); }

  /// Sends the next command when one waits and its time has come. While a transfer is in progress only a stop
  /// is sent, at once: the transfer is aborted, so the controller does not receive two commands within the
  /// spacing. STOP is sent in this way when a setpoint is in transfer and a standstill waits; the standstill
  /// follows.
  types::Status pump();
  /// Sends ahead of the queue, without spacing: for a last command before the line is closed. E_STOP does not
  /// wait; other commands wait for the transfer in progress, 100 ms at most, and discard input received
  /// meanwhile.
  types::Status send_at_once(const CommandPacket& packet);
  /// Discards waiting commands, and the transfer in progress: a stop that aborts it does not queue it again.
  void clear();
  /// True when all commands have been sent.
  [[nodiscard]] bool all_sent() const { return outbox_.empty() && stream_->ready(); }
  /// Time of the next pump() with an effect; far in the future when no command waits, or while a transfer is
  /// in progress: receive() returns at its end.
  [[nodiscard]] types::Stamp next_send() const;
  /// Time of the last command; the connection's start before the first.
  [[nodiscard]] types::Stamp last_send() const { return last_send_; }

  /// Reads, unless bytes still wait to be parsed. Blocks at most `timeout`.
  types::Status receive(types::Duration timeout);
  /// Start of the last actual read: all input from before it has been processed.
  [[nodiscard]] types::Stamp last_read() const { return last_read_; }
  /// What next_packet() gives now had not ended before: the end of the read before the one that it came by.
  [[nodiscard]] types::Stamp heard_after() const { return heard_after_; }
  /// When the last ENCODER had been written; the connection's start before the first.
  [[nodiscard]] types::Stamp last_request() const { return last_request_; }
  std::optional<PacketView> next_packet();

  /// CONFIG packets that came damaged, since the construction.
  [[nodiscard]] std::uint64_t damaged_configs() const { return parser_.counters().bad_configs; }

  /// Also discards a partial packet and the recorded first bytes.
  types::Status set_baud(int baud);
  [[nodiscard]] types::Duration wire_time(std::size_t bytes) const;

  /// First bytes received at this speed, for a message: as text when printable, hexadecimal otherwise.
  /// Allocates.
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
  std::optional<CommandPacket> last_;  ///< last command taken from it, unless it was a stop
  PacketParser parser_;
  int baud_ = 0;  ///< 0: the line has no speed
  types::Stamp last_send_;
  types::Stamp send_after_;
  types::Stamp last_read_, read_ended_, heard_after_;
  types::Stamp last_request_;
  std::array<std::byte, 2048> buffer_{};
  std::span<const std::byte> pending_;
  types::Stamp pending_stamp_{};
  std::array<std::byte, 24> heard_{};
  std::size_t heard_size_ = 0;
  std::uint64_t bad_before_ = 0;
  io::BusFaults bus_before_;
};

}  // namespace topo::pioneer
