// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// The simulator's own ARCOS framing (PROTOCOLS section 1). It shares no code with the driver: only the
/// vectors of PROTOCOLS section 16 are common to both.
namespace topo::sim::arcos {

[[nodiscard]] std::uint16_t checksum(std::string_view payload);

/// Builds a robot's packet: type byte, then little-endian fields.
class PacketBuilder {
 public:
  explicit PacketBuilder(std::uint8_t type) { u8(type); }
  PacketBuilder& u8(int value) {
    payload_.push_back(static_cast<char>(value & 0xFF));
    return *this;
  }
  PacketBuilder& u16(int value) { return u8(value).u8(value >> 8); }
  PacketBuilder& i32(std::int32_t value) { return u16(value).u16(value >> 16); }
  PacketBuilder& text(std::string_view value) {
    payload_.append(value).push_back('\0');
    return *this;
  }
  /// The packet with header, count and checksum.
  [[nodiscard]] std::string frame() const;

 private:
  std::string payload_;
};

/// A command from the host.
struct Command {
  std::uint8_t number = 0;
  bool has_argument = false;
  int value = 0;      ///< integer argument with its sign; 0 when there is none
  std::string bytes;  ///< string argument
};

/// Decodes a payload. Tolerant like the firmware: a truncated argument counts as none.
[[nodiscard]] Command decode_command(std::string_view payload);

/// Finds packets in a stream of bytes. Skips only two bytes after a wrong checksum, so that it finds a packet
/// inside garbage. Memory is bounded by one packet.
class Receiver {
 public:
  /// Calls sink(Command) for each good packet.
  template <class Sink>
  void feed(std::span<const std::uint8_t> bytes, Sink&& sink) {
    for (const std::uint8_t byte : bytes) {
      buffer_.push_back(static_cast<char>(byte));
      while (auto payload = take_packet()) sink(decode_command(*payload));
    }
  }
  void clear() { buffer_.clear(); }
  [[nodiscard]] std::uint64_t bad_checksums() const { return bad_checksums_; }

 private:
  std::optional<std::string> take_packet();

  std::string buffer_;
  std::uint64_t bad_checksums_ = 0;
};

}  // namespace topo::sim::arcos
