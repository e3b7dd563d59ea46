// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/team/exchange/item.hpp"
#include "core/team/exchange/news.hpp"
#include "core/team/exchange/params.hpp"
#include "core/types/bytes.hpp"

// A datagram, little-endian:
//
//   u8 'T', u8 version, u32 team, u16 robot, u32 run, u32 counter of the sender's datagrams in this run
//   messages: u8 kind, varint length, body
//
// A reader of this version skips a message of a kind that it does not know, so that kinds can be added.
namespace topo::team {

inline constexpr std::uint8_t kWireMagic = 'T';
inline constexpr std::uint8_t kWireVersion = 1;
inline constexpr std::size_t kHeadBytes = 16;
/// Of a body: kind and length take three bytes at most.
inline constexpr std::size_t kBodyBytesMax = kDatagramBytesMax - kHeadBytes - 3;

struct DatagramHead {
  std::uint32_t team = 0;
  slam::Origin sender;
  std::uint32_t counter = 0;
};

enum class HeadVerdict : std::uint8_t { kGood, kMalformed, kOtherVersion };

/// Reads the head of hostile bytes into `head`; only kGood has written it.
[[nodiscard]] HeadVerdict read_head(std::span<const std::byte> datagram, DatagramHead& head);

struct Message {
  std::uint8_t kind = 0;  ///< a MessageKind, or one of a later program
  std::span<const std::byte> body;
};

/// The messages of a datagram in their order.
class MessageReader {
 public:
  explicit MessageReader(std::span<const std::byte> datagram);
  /// Nothing at the end, and nothing from the first fault on.
  std::optional<Message> next();
  [[nodiscard]] bool ok() const { return ok_; }

 private:
  std::span<const std::byte> rest_;
  bool ok_ = true;
};

/// Puts messages into one datagram.
class DatagramWriter {
 public:
  explicit DatagramWriter(const DatagramHead& head);
  [[nodiscard]] bool fits(std::size_t body_bytes) const;
  /// Precondition: fits.
  void add(MessageKind kind, std::span<const std::byte> body);
  [[nodiscard]] bool empty() const { return bytes_.size() == kHeadBytes; }
  [[nodiscard]] std::size_t size() const { return bytes_.size(); }
  [[nodiscard]] std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  std::vector<std::byte> bytes_;
};

/// True when datagram counter `a` is later than `b`; they wrap around.
[[nodiscard]] constexpr bool is_later(std::uint32_t a, std::uint32_t b) {
  return a != b && a - b < (1U << 31U);
}

void write_origin(types::ByteWriter& out, const slam::Origin& origin);
/// Numbers out of range spoil the reader: `ok` becomes false.
[[nodiscard]] slam::Origin read_origin(types::ByteReader& in, bool& ok);
void write_stream(types::ByteWriter& out, const StreamKey& key);
[[nodiscard]] StreamKey read_stream(types::ByteReader& in, bool& ok);
void write_key(types::ByteWriter& out, const ItemKey& key);
[[nodiscard]] ItemKey read_key(types::ByteReader& in, bool& ok);

}  // namespace topo::team
