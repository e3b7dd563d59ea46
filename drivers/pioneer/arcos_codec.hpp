// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "core/types/stamp.hpp"

// ARCOS packets (PROTOCOLS section 1): bytes in, values out. No descriptor, no clock, no allocation.
namespace topo::pioneer {

inline constexpr std::size_t kMinCount = 3;    ///< smallest N: a type byte and the checksum
inline constexpr std::size_t kMaxCount = 204;  ///< ARCOS drops longer packets
inline constexpr std::size_t kMaxPacket = kMaxCount + 3;

/// Host to robot (PROTOCOLS section 3). 0, 1 and 2 are SYNC0, SYNC1 and SYNC2 before the connection.
enum class Command : std::uint8_t {
  kPulse = 0,
  kOpen = 1,
  kClose = 2,
  kEnable = 4,
  kSetA = 5,
  kSetV = 6,
  kSetO = 7,
  kSetRv = 10,
  kVel = 11,
  kConfig = 18,
  kEncoder = 19,
  kRvel = 21,
  kSetRa = 23,
  kSonar = 28,
  kStop = 29,
  kBumpStall = 44,
  kHostBaud = 50,
  kEStop = 55,
  kGyro = 58,
};

/// Robot to host (PROTOCOLS sections 4 and 5).
enum class PacketType : std::uint8_t {
  kSync0 = 0x00,
  kSync1 = 0x01,
  kSync2 = 0x02,
  kConfig = 0x20,
  kStatusStopped = 0x32,
  kStatusMoving = 0x33,
  kEncoder = 0x90,
  kGyro = 0x98,
  kResetWithDiagnosis = 0xFE,
  kReset = 0xFF,
};

/// Sum of big-endian words modulo 2^16; an odd last byte is XORed into the low byte.
std::uint16_t checksum(std::span<const std::byte> payload);

/// One framed command in storage of its own.
class CommandPacket {
 public:
  CommandPacket() = default;
  [[nodiscard]] std::span<const std::byte> bytes() const { return {bytes_.data(), size_}; }
  [[nodiscard]] bool is(Command command) const;
  /// VEL or RVEL.
  [[nodiscard]] bool is_setpoint() const;
  [[nodiscard]] bool is_emergency_stop() const;

 private:
  friend class CommandWriter;
  std::array<std::byte, kMaxPacket> bytes_{};
  std::size_t size_ = 0;
};

CommandPacket encode(Command command);
/// Encodes the sign in the argument's type byte; clamps to +-32767.
CommandPacket encode(Command command, int argument);

/// A packet with valid frame and checksum. Valid until the parser's next call.
struct PacketView {
  std::span<const std::byte> payload;  ///< type byte and data, never empty
  types::Stamp first_byte{};           ///< stamp of the read that returned its first byte
  types::Stamp last_byte{};

  [[nodiscard]] std::uint8_t type() const { return std::to_integer<std::uint8_t>(payload.front()); }
  [[nodiscard]] bool is(PacketType wanted) const { return type() == static_cast<std::uint8_t>(wanted); }
  /// 0x3x: identifies an open connection for all firmware versions (PROTOCOLS section 4).
  [[nodiscard]] bool is_status() const { return (type() & 0xF0U) == 0x30U; }
  [[nodiscard]] std::size_t wire_bytes() const { return payload.size() + 5; }
};

struct ParserCounters {
  std::uint64_t packets = 0;
  std::uint64_t bad_checksums = 0;
  std::uint64_t bad_configs = 0;    ///< of the damaged packets, those whose type is that of CONFIG
  std::uint64_t bad_counts = 0;     ///< N below 3 or above 204
  std::uint64_t abandoned = 0;      ///< a gap of more than 100 ms inside
  std::uint64_t skipped_bytes = 0;  ///< bytes that belonged to no packet
};

/// Finds packets in a stream of bytes. After bytes that are not a packet it advances by one byte and searches
/// again, because FA FB may be data and because a packet may begin inside a broken one.
class PacketParser {
 public:
  /// Takes bytes from the front of `input` until a packet is complete or `input` is consumed. `stamp` is the
  /// time of the read; with an empty `input`, the time until which no byte arrived: a controller that is
  /// reset during a packet sends its reset message behind the incomplete packet and then nothing more. Call
  /// again with the remaining input until no packet is returned.
  std::optional<PacketView> next(std::span<const std::byte>& input, types::Stamp stamp);
  void reset();
  [[nodiscard]] const ParserCounters& counters() const { return counters_; }

 private:
  static constexpr types::Duration kGapMax = std::chrono::milliseconds(100);
  enum class Candidate { kIncomplete, kBroken, kPacket };

  [[nodiscard]] std::size_t wanted() const;
  Candidate judge();
  void count_damage();
  bool seek_packet();
  void drop(std::size_t bytes);
  void drop_to_next_sync();
  void abandon_incomplete();
  void append(std::span<const std::byte>& input, types::Stamp stamp);
  [[nodiscard]] PacketView view() const;

  std::array<std::byte, kMaxPacket> bytes_{};
  std::array<types::Stamp, kMaxPacket> stamps_{};
  std::size_t size_ = 0;
  std::size_t delivered_ = 0;  ///< bytes of the last returned packet, still at the front
  bool gap_ = false;           ///< the buffered packet will not be completed
  ParserCounters counters_;
};

}  // namespace topo::pioneer
