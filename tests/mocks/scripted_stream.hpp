// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/io/byte_stream.hpp"

namespace topo::mocks {

/// The far end of a scripted stream, on a clock of its own: a read that waits moves this clock, so that
/// minutes of silence pass in microseconds and every run is the same. One thread.
class ScriptedLine {
 public:
  /// Called with every write; usually answers with send().
  std::function<void(std::string_view bytes)> on_write;
  /// Called before a read that may last until `until`: a device that sends by itself queues its bytes here.
  std::function<void(types::Stamp until)> on_wait;
  /// Called at every connection that is accepted.
  std::function<void()> on_connect;

  types::Stamp now{std::chrono::seconds(1000)};
  bool refuse = false;  ///< connect() fails with kNotFound
  bool has_baud = false;
  int baud = 0;  ///< last line speed that was set
  int connections = 0;
  int connect_calls = 0;
  std::vector<types::Stamp> connect_stamps;             ///< of every attempt
  std::size_t max_read = static_cast<std::size_t>(-1);  ///< most bytes one read gives: splits packets
  std::string written;                                  ///< everything since the last clear

  /// Bytes arrive at `when` (not before what was queued earlier).
  void send_at(types::Stamp when, std::string_view bytes);
  void send(std::string_view bytes) { send_at(now, bytes); }
  /// The device is unplugged now: what is queued is lost; reads and writes fail until the next connection.
  void unplug();
  /// Forgets what was queued and not yet read.
  void clear_queue();
  [[nodiscard]] bool connected() const { return connected_; }

 private:
  friend class ScriptedStream;
  friend class ScriptedConnector;
  struct Chunk {
    types::Stamp when;
    std::string bytes;
  };
  io::ReadResult take(std::span<std::byte> buffer, types::Duration timeout);

  std::vector<Chunk> queue_;  ///< never shrinks while reading: a read allocates and frees nothing
  std::size_t head_ = 0;
  std::size_t offset_ = 0;
  bool connected_ = false;
  int generation_ = 0;
};

/// Connects to a scripted line; the line outlives it.
class ScriptedConnector final : public io::Connector {
 public:
  explicit ScriptedConnector(ScriptedLine& line) : line_(&line) {}
  io::Result<std::unique_ptr<io::ByteStream>> connect(types::Duration timeout) override;
  [[nodiscard]] std::string_view name() const override { return "/dev/scripted"; }
  [[nodiscard]] types::Stamp now() const override { return line_->now; }
  void pause(types::Duration duration) override { line_->now += duration; }

 private:
  ScriptedLine* line_;
};

}  // namespace topo::mocks
