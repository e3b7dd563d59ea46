// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/sim/devices/arcos_packet.hpp"

namespace topo::sim::arcos {
namespace {

constexpr char kHead0 = '\xFA';
constexpr char kHead1 = '\xFB';
constexpr unsigned kCountLeast = 3;
constexpr unsigned kCountMost = 204;  // ARCOS drops longer packets (PROTOCOLS section 1)

unsigned byte_at(std::string_view text, std::size_t at) { return static_cast<unsigned char>(text[at]); }

}  // namespace

std::uint16_t checksum(std::string_view payload) {
  unsigned sum = 0;
  std::size_t at = 0;
  for (; at + 1 < payload.size(); at += 2) {
    sum = (sum + (byte_at(payload, at) << 8 | byte_at(payload, at + 1))) & 0xFFFFU;
  }
  if (at < payload.size()) sum ^= byte_at(payload, at);
  return static_cast<std::uint16_t>(sum);
}

std::string PacketBuilder::frame() const {
  const unsigned sum = checksum(payload_);
  std::string out{kHead0, kHead1, static_cast<char>(payload_.size() + 2)};
  out.append(payload_);
  out.push_back(static_cast<char>(sum >> 8));
  out.push_back(static_cast<char>(sum & 0xFFU));
  return out;
}

Command decode_command(std::string_view payload) {
  constexpr unsigned kPositive = 0x3B;
  constexpr unsigned kNegative = 0x1B;
  constexpr unsigned kString = 0x2B;
  Command command;
  if (payload.empty()) return command;
  command.number = static_cast<std::uint8_t>(byte_at(payload, 0));
  if (payload.size() < 2) return command;
  const unsigned kind = byte_at(payload, 1);
  if ((kind == kPositive || kind == kNegative) && payload.size() >= 4) {
    const int magnitude = static_cast<int>(byte_at(payload, 2) | byte_at(payload, 3) << 8);
    command.value = kind == kNegative ? -magnitude : magnitude;
    command.has_argument = true;
  } else if (kind == kString && payload.size() >= 3) {
    command.bytes = std::string(payload.substr(3, byte_at(payload, 2)));
    command.has_argument = true;
  }
  return command;
}

std::optional<std::string> Receiver::take_packet() {
  while (!buffer_.empty()) {
    if (buffer_[0] != kHead0 || (buffer_.size() > 1 && buffer_[1] != kHead1)) {
      buffer_.erase(0, 1);
      continue;
    }
    if (buffer_.size() < 3) return std::nullopt;
    const unsigned count = byte_at(buffer_, 2);
    if (count < kCountLeast || count > kCountMost) {
      buffer_.erase(0, 2);
      continue;
    }
    if (buffer_.size() < count + 3) return std::nullopt;
    const std::string payload = buffer_.substr(3, count - 2);
    const unsigned sum = byte_at(buffer_, count + 1) << 8 | byte_at(buffer_, count + 2);
    if (sum != checksum(payload)) {
      ++bad_checksums_;
      buffer_.erase(0, 2);
      continue;
    }
    buffer_.erase(0, count + 3);
    return payload;
  }
  return std::nullopt;
}

}  // namespace topo::sim::arcos
