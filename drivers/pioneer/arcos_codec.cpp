// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/pioneer/arcos_codec.hpp"

#include <algorithm>

#include "core/types/invariant.hpp"

namespace topo::pioneer {
namespace {

constexpr std::byte kHead1{0xFA};
constexpr std::byte kHead2{0xFB};
constexpr std::byte kTypePositive{0x3B};
constexpr std::byte kTypeNegative{0x1B};

constexpr unsigned value(std::byte b) { return std::to_integer<unsigned>(b); }
constexpr std::byte low_byte(unsigned v) { return static_cast<std::byte>(v & 0xFFU); }

}  // namespace

std::uint16_t checksum(std::span<const std::byte> payload) {
  unsigned sum = 0;
  std::size_t i = 0;
  for (; i + 1 < payload.size(); i += 2) sum += value(payload[i]) << 8U | value(payload[i + 1]);
  sum &= 0xFFFFU;
  if (i < payload.size()) sum ^= value(payload[i]);
  return static_cast<std::uint16_t>(sum);
}

bool CommandPacket::is(Command command) const { return bytes_[3] == static_cast<std::byte>(command); }

bool CommandPacket::is_setpoint() const { return is(Command::kVel) || is(Command::kRvel); }

bool CommandPacket::is_emergency_stop() const { return is(Command::kEStop); }

/// Fills a CommandPacket: head, payload byte by byte, count and checksum at the end.
class CommandWriter {
 public:
  explicit CommandWriter(Command command) { put(static_cast<std::byte>(command)); }
  void put(std::byte b) {
    types::require(kPayload + used_ + kChecksum < kMaxPacket,
                   "pioneer::CommandWriter: a command longer than a packet");
    packet_.bytes_[kPayload + used_++] = b;
  }
  void put_word(unsigned v) {
    put(low_byte(v));
    put(low_byte(v >> 8U));
  }
  CommandPacket finish() {
    const std::uint16_t sum = checksum({packet_.bytes_.data() + kPayload, used_});
    packet_.bytes_[0] = kHead1;
    packet_.bytes_[1] = kHead2;
    packet_.bytes_[2] = low_byte(static_cast<unsigned>(used_) + 2);
    packet_.bytes_[kPayload + used_] = low_byte(sum >> 8U);
    packet_.bytes_[kPayload + used_ + 1] = low_byte(sum);
    packet_.size_ = kPayload + used_ + 2;
    return packet_;
  }

 private:
  static constexpr std::size_t kPayload = 3, kChecksum = 2;  // bytes before and after the payload
  CommandPacket packet_;
  std::size_t used_ = 0;
};

CommandPacket encode(Command command) { return CommandWriter(command).finish(); }

CommandPacket encode(Command command, int argument) {
  constexpr int kLargest = 32767;
  const int clamped = std::clamp(argument, -kLargest, kLargest);
  CommandWriter writer(command);
  writer.put(clamped < 0 ? kTypeNegative : kTypePositive);
  writer.put_word(static_cast<unsigned>(clamped < 0 ? -clamped : clamped));
  return writer.finish();
}

std::optional<PacketView> PacketParser::next(std::span<const std::byte>& input, types::Stamp stamp) {
  drop(delivered_);
  delivered_ = 0;
  if (size_ > 0 && stamp - stamps_[size_ - 1] > kGapMax) gap_ = true;
  for (;;) {
    if (seek_packet()) {
      delivered_ = wanted();
      ++counters_.packets;
      return view();
    }
    if (gap_) {
      abandon_incomplete();
      continue;
    }
    if (input.empty()) return std::nullopt;
    append(input, stamp);
  }
}

void PacketParser::reset() {
  size_ = 0;
  delivered_ = 0;
  gap_ = false;
}

std::size_t PacketParser::wanted() const { return size_ < 3 ? 3 : value(bytes_[2]) + 3; }

PacketParser::Candidate PacketParser::judge() {
  if (bytes_[0] != kHead1 || (size_ > 1 && bytes_[1] != kHead2)) return Candidate::kBroken;
  if (size_ < 3) return Candidate::kIncomplete;
  const std::size_t count = value(bytes_[2]);
  if (count < kMinCount || count > kMaxCount) {
    ++counters_.bad_counts;
    return Candidate::kBroken;
  }
  if (size_ < count + 3) return Candidate::kIncomplete;
  const unsigned found = value(bytes_[count + 1]) << 8U | value(bytes_[count + 2]);
  if (found == checksum({bytes_.data() + 3, count - 2})) return Candidate::kPacket;
  ++counters_.bad_checksums;
  count_damage();
  return Candidate::kBroken;
}

void PacketParser::count_damage() {
  constexpr std::size_t kType = 3;
  if (size_ > kType && value(bytes_[kType]) == static_cast<unsigned>(PacketType::kConfig))
    ++counters_.bad_configs;
}

/// True when a complete packet is at the front; otherwise the buffer is empty or begins with part of a
/// packet.
bool PacketParser::seek_packet() {
  while (size_ > 0) {
    const Candidate candidate = judge();
    if (candidate == Candidate::kPacket) return true;
    if (candidate == Candidate::kIncomplete) return false;
    drop_to_next_sync();
  }
  return false;
}

void PacketParser::drop(std::size_t bytes) {
  types::require(bytes <= size_, "pioneer::PacketParser: more bytes dropped than are there");
  std::copy(bytes_.begin() + static_cast<std::ptrdiff_t>(bytes),
            bytes_.begin() + static_cast<std::ptrdiff_t>(size_), bytes_.begin());
  std::copy(stamps_.begin() + static_cast<std::ptrdiff_t>(bytes),
            stamps_.begin() + static_cast<std::ptrdiff_t>(size_), stamps_.begin());
  size_ -= bytes;
}

void PacketParser::drop_to_next_sync() {
  const auto end = bytes_.begin() + static_cast<std::ptrdiff_t>(size_);
  const auto bytes = static_cast<std::size_t>(std::find(bytes_.begin() + 1, end, kHead1) - bytes_.begin());
  counters_.skipped_bytes += bytes;
  drop(bytes);
}

/// The packet at the front will not be completed, but a complete packet may follow its header.
void PacketParser::abandon_incomplete() {
  if (size_ == 0) {
    gap_ = false;
    return;
  }
  ++counters_.abandoned;
  count_damage();
  drop_to_next_sync();
}

/// Never takes bytes beyond the candidate, whose count was checked before: the buffer cannot overflow.
void PacketParser::append(std::span<const std::byte>& input, types::Stamp stamp) {
  types::require(size_ <= wanted() && wanted() <= bytes_.size(),
                 "pioneer::PacketParser: a packet longer than allowed");
  const std::size_t taken = std::min(wanted() - size_, input.size());
  std::copy_n(input.begin(), taken, bytes_.begin() + static_cast<std::ptrdiff_t>(size_));
  std::fill_n(stamps_.begin() + static_cast<std::ptrdiff_t>(size_), taken, stamp);
  size_ += taken;
  input = input.subspan(taken);
}

PacketView PacketParser::view() const {
  const std::size_t total = wanted();
  return {{bytes_.data() + 3, total - 5}, stamps_[0], stamps_[total - 1]};
}

}  // namespace topo::pioneer
