// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/recording/format.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <cstring>
#include <string_view>

#include "core/types/bytes.hpp"

namespace topo::daemon {

namespace {

constexpr std::string_view kMagic{"TOPOREC\0", 8};
constexpr std::string_view kFrameMagic = "TFRM";
constexpr std::size_t kFixedHeader = 16;  // magic, version, length of the body
constexpr std::size_t kFixedBody = 26;
constexpr std::int64_t kMaxSteady_ns = std::int64_t{1}
                                       << 60;  // 36 years of uptime; the sum of two cannot overflow

std::string_view text_of(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

void append(std::vector<std::byte>& out, std::string_view text) {
  const auto bytes = std::as_bytes(std::span(text));
  out.insert(out.end(), bytes.begin(), bytes.end());
}

template <class Integer>
void append_le(std::vector<std::byte>& out, Integer value) {
  out.resize(out.size() + sizeof(Integer));
  types::store_le(std::span(out), out.size() - sizeof(Integer), value);
}

DecodedHeader fault(std::size_t offset, std::string found, std::string expected) {
  return {std::nullopt, 0, {offset, std::move(found), std::move(expected)}};
}

/// Names of the channels in a body with a valid checksum; nothing when they do not fill it exactly.
std::optional<std::vector<std::string>> decode_channels(std::span<const std::byte> names, std::size_t count) {
  std::vector<std::string> channels;
  for (std::size_t i = 0; i < count; ++i) {
    if (names.size() < 2) return std::nullopt;
    const std::size_t length = types::load_le<std::uint16_t>(names, 0);
    if (length > kMaxChannelName || names.size() - 2 < length) return std::nullopt;
    channels.emplace_back(text_of(names.subspan(2, length)));
    names = names.subspan(2 + length);
  }
  if (!names.empty()) return std::nullopt;
  return channels;
}

}  // namespace

std::uint64_t checksum(std::span<const std::byte> bytes) noexcept {
  return XXH64(bytes.data(), bytes.size(), 0);
}

std::vector<std::byte> encode_header(const RecordingHeader& header) {
  std::vector<std::byte> out;
  append(out, kMagic);
  append_le(out, kRecordingVersion);
  append_le(out, std::uint32_t{0});
  append_le(out, header.config_hash);
  append_le(out, header.wall_start_ns);
  append_le(out, header.steady_start_ns);
  append_le(out, static_cast<std::uint16_t>(header.channels.size()));
  for (const std::string& name : header.channels) {
    append_le(out, static_cast<std::uint16_t>(name.size()));
    append(out, name);
  }
  types::store_le(std::span(out), 12, static_cast<std::uint32_t>(out.size() - kFixedHeader));
  append_le(out, checksum(out));
  return out;
}

DecodedHeader decode_header(std::span<const std::byte> file) {
  const std::size_t compare = std::min(file.size(), kMagic.size());
  if (text_of(file.first(compare)) != kMagic.substr(0, compare) || file.empty()) {
    return fault(0, file.empty() ? "an empty file" : "other content",
                 "a recording, which begins with TOPOREC");
  }
  if (file.size() < kFixedHeader) {
    return fault(file.size(), "the end of the file",
                 fmt::format("a header of at least {} bytes", kFixedHeader));
  }
  const auto version = types::load_le<std::uint32_t>(file, 8);
  if (version != kRecordingVersion) {
    return fault(8, fmt::format("format version {}", version), fmt::format("version {}", kRecordingVersion));
  }
  const std::size_t body_bytes = types::load_le<std::uint32_t>(file, 12);
  if (body_bytes < kFixedBody || body_bytes > kMaxHeaderBody) {
    return fault(12, fmt::format("a header of {} bytes", body_bytes),
                 fmt::format("{} to {}", kFixedBody, kMaxHeaderBody));
  }
  const std::size_t end = kFixedHeader + body_bytes;
  if (file.size() < end + 8)
    return fault(file.size(), "the end of the file", fmt::format("a header of {} bytes", end + 8));
  if (types::load_le<std::uint64_t>(file, end) != checksum(file.first(end))) {
    return fault(end, "a wrong checksum of the header", "the one of its bytes");
  }
  const auto body = file.subspan(kFixedHeader, body_bytes);
  RecordingHeader header{types::load_le<std::uint64_t>(body, 0),
                         types::load_le<std::int64_t>(body, 8),
                         types::load_le<std::int64_t>(body, 16),
                         {}};
  if (header.steady_start_ns < 0 || header.steady_start_ns > kMaxSteady_ns) {
    return fault(kFixedHeader + 16, fmt::format("a start at {} ns", header.steady_start_ns),
                 "a steady clock's time");
  }
  const std::size_t count = types::load_le<std::uint16_t>(body, 24);
  auto channels = decode_channels(body.subspan(kFixedBody), count);
  if (!channels.has_value() || count > kMaxChannels) {
    return fault(kFixedHeader + 24, fmt::format("{} channels that do not fill the header", count),
                 fmt::format("at most {} with their names", kMaxChannels));
  }
  header.channels = std::move(*channels);
  return {std::move(header), end + 8, {}};
}

std::array<std::byte, FrameHead::kSize> encode_frame_head(const FrameHead& head) {
  std::array<std::byte, FrameHead::kSize> out{};
  std::memcpy(out.data(), kFrameMagic.data(), kFrameMagic.size());
  types::store_le(std::span(out), 4, head.packed_bytes);
  types::store_le(std::span(out), 8, head.raw_bytes);
  types::store_le(std::span(out), 12, head.channel_mask);
  types::store_le(std::span(out), 16, head.number);
  types::store_le(std::span(out), 24, head.checksum);
  types::store_le(std::span(out), 32, checksum(std::span(out).first(32)));
  return out;
}

std::optional<FrameHead> decode_frame_head(std::span<const std::byte, FrameHead::kSize> bytes) {
  if (text_of(bytes.first(4)) != kFrameMagic) return std::nullopt;
  if (types::load_le<std::uint64_t>(bytes, 32) != checksum(bytes.first(32))) return std::nullopt;
  const FrameHead head{types::load_le<std::uint32_t>(bytes, 4), types::load_le<std::uint32_t>(bytes, 8),
                       types::load_le<std::uint32_t>(bytes, 12), types::load_le<std::uint64_t>(bytes, 16),
                       types::load_le<std::uint64_t>(bytes, 24)};
  if (head.packed_bytes > kMaxFrameBytes || head.raw_bytes > kMaxFrameBytes) return std::nullopt;
  return head;
}

std::array<std::byte, RecordHead::kSize> encode_record_head(const RecordHead& head) noexcept {
  std::array<std::byte, RecordHead::kSize> out{};
  out[0] = static_cast<std::byte>(head.channel);
  out[1] = static_cast<std::byte>(head.kind);
  types::store_le(std::span(out), 4, head.length);
  types::store_le(std::span(out), 8, static_cast<std::int64_t>(head.stamp.time_since_epoch().count()));
  return out;
}

std::optional<RecordHead> decode_record_head(std::span<const std::byte> bytes) noexcept {
  if (bytes.size() < RecordHead::kSize) return std::nullopt;
  const auto kind = std::to_integer<std::uint8_t>(bytes[1]);
  const auto length = types::load_le<std::uint32_t>(bytes, 4);
  const auto stamp_ns = types::load_le<std::int64_t>(bytes, 8);
  if (kind > static_cast<std::uint8_t>(RecordKind::kEnd) || length > kMaxRecordBytes) return std::nullopt;
  if (stamp_ns < 0 || stamp_ns > kMaxSteady_ns) return std::nullopt;
  return RecordHead{std::to_integer<std::uint8_t>(bytes[0]), static_cast<RecordKind>(kind), length,
                    types::Stamp{types::Duration{stamp_ns}}};
}

}  // namespace topo::daemon
