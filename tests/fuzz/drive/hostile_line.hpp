// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "drivers/io/byte_stream.hpp"

namespace topo::fuzz {

/// What a line does to the bytes of its device.
struct LineFaults {
  types::Duration delay{};         ///< of everything
  types::Duration delay_growth{};  ///< of every message more than of the one before
  unsigned drop_permille = 0;      ///< of bytes
  unsigned flip_permille = 0;      ///< of bytes, one bit
  bool holds = false;              ///< nothing arrives until it ends, then all at once
  bool swallows = false;           ///< whole messages are lost
};

/// What a message says of the world.
struct Says {
  bool news = false;  ///< what it is like now
  unsigned lie = 0;   ///< above 0: which lie of the device
};

/// What the host has heard.
struct Heard {
  types::Stamp news{};  ///< when the newest undamaged news was sent; zero: none came
  types::Stamp lie{};   ///< the same of lies
  int lies = 0;         ///< that came in a row, the same without news between
};

/// The way from a device to the host: messages, the faults, and which of the undamaged ones arrived. Pure but
/// for its dice, which are the same in every run.
class HostileLine {
 public:
  LineFaults faults;

  /// A message that the device sends at `now`.
  void send(std::string_view message, types::Stamp now, const Says& says);
  /// Bytes that no device sent.
  void inject(std::string_view bytes, types::Stamp now) { put(std::string(bytes), now, now, {}); }
  /// Sends once more what was sent last, unchanged.
  void replay(types::Stamp now) { put(last_, now, now, {}); }
  void clear();
  void begin_delay() { delay_ = faults.delay; }

  /// The bytes that have arrived by `now`, at most `most`.
  std::string read(types::Stamp now, std::size_t most);
  [[nodiscard]] bool has(types::Stamp now) const;
  [[nodiscard]] const Heard& heard() const { return heard_; }
  /// The delay with which the newest stream of news began: one way it cannot be seen.
  [[nodiscard]] types::Duration began_late() const { return began_late_; }

 private:
  struct Chunk {
    types::Stamp due;
    std::string bytes;
    types::Stamp sent;
    Says says;  ///< nothing when it was damaged
  };
  void put(std::string bytes, types::Stamp due, types::Stamp sent, const Says& says);
  void hear(const Chunk& chunk);
  std::uint32_t roll();

  std::deque<Chunk> queue_;
  std::size_t offset_ = 0;  ///< bytes of the first chunk that were read
  std::string last_;
  Heard heard_;
  unsigned last_lie_ = 0;
  types::Stamp last_due_{};
  types::Duration delay_{}, began_late_{};
  types::Stamp last_sent_{};
  std::uint32_t dice_ = 1;
};

/// One opened port at the end of a line.
struct HostilePort {
  HostileLine* line = nullptr;
  types::Stamp now{};  ///< of the thread that uses it
  bool unplugged = false;
  std::uint64_t opened = 0;
  /// Runs the world up to this time.
  std::function<void(types::Stamp)> advance;
  std::function<void(std::string_view)> on_write;
};

/// The host's end. The port outlives it.
class HostileConnector final : public io::Connector {
 public:
  explicit HostileConnector(HostilePort& port) : port_(&port) {}
  io::Result<std::unique_ptr<io::ByteStream>> connect(types::Duration timeout) override;
  [[nodiscard]] std::string_view name() const override { return "/dev/hostile"; }
  [[nodiscard]] types::Stamp now() const override { return port_->now; }
  void pause(types::Duration duration) override;

 private:
  HostilePort* port_;
};

}  // namespace topo::fuzz
