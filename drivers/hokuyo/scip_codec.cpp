// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/hokuyo/scip_codec.hpp"

#include <algorithm>
#include <utility>

namespace topo::hokuyo {
namespace {

using Kind = StreamRequest::Kind;

constexpr std::array<std::pair<Kind, std::string_view>, 5> kNames{{{Kind::kRange, "MD"},
                                                                   {Kind::kRangeShort, "MS"},
                                                                   {Kind::kRangeIntensity, "ME"},
                                                                   {Kind::kMultiEcho, "ND"},
                                                                   {Kind::kMultiIntensity, "NE"}}};
constexpr std::size_t kEchoSize = 15;

unsigned read_digits(std::string_view digits) {
  unsigned value = 0;
  for (const char c : digits) value = value * 10 + static_cast<unsigned>(c - '0');
  return value;
}

}  // namespace

char checksum(std::string_view text) {
  unsigned sum = 0;
  for (const char c : text) sum += static_cast<unsigned char>(c);
  return static_cast<char>((sum & 0x3FU) + 0x30U);
}

std::optional<std::string_view> checked(std::string_view line) {
  if (line.size() < 2) return std::nullopt;
  const std::string_view text = line.substr(0, line.size() - 1);
  if (checksum(text) != line.back()) return std::nullopt;
  return text;
}

std::optional<std::uint32_t> decode_number(std::string_view text) {
  constexpr std::size_t kMaxCharacters = 5;  // 30 bits
  if (text.empty() || text.size() > kMaxCharacters) return std::nullopt;
  std::uint32_t value = 0;
  for (const char c : text) {
    if (c < 0x30 || c > 0x6F) return std::nullopt;
    value = value << 6U | static_cast<std::uint32_t>(c - 0x30);
  }
  return value;
}

std::size_t StreamRequest::points() const {
  if (end < start) return 0;
  const std::size_t steps = static_cast<std::size_t>(end - start) + 1;
  const std::size_t group = std::max<std::size_t>(cluster, 1);  // 00 equals 01
  return (steps + group - 1) / group;
}

bool StreamRequest::same_stream(const StreamRequest& other) const {
  return kind == other.kind && start == other.start && end == other.end && cluster == other.cluster &&
         interval == other.interval;
}

void RequestText::append(std::string_view text) {
  const std::size_t taken = std::min(text.size(), text_.size() - size_);
  std::copy_n(text.data(), taken, text_.data() + size_);
  size_ += taken;
}

void RequestText::append_number(unsigned value, std::size_t digits) {
  std::array<char, 8> text{};
  const std::size_t width = std::min(digits, text.size());
  for (std::size_t i = width; i > 0; --i) {
    text[i - 1] = static_cast<char>('0' + value % 10);
    value /= 10;
  }
  append({text.data(), width});
}

RequestText encode(const StreamRequest& request) {
  RequestText text;
  for (const auto& [kind, name] : kNames) {
    if (kind == request.kind) text.append(name);
  }
  text.append_number(request.start, 4);
  text.append_number(request.end, 4);
  text.append_number(request.cluster, 2);
  text.append_number(request.interval, 1);
  text.append_number(request.count, 2);
  return text;
}

std::optional<StreamRequest> parse_stream_echo(std::string_view echo) {
  if (echo.size() != kEchoSize) return std::nullopt;
  const std::string_view digits = echo.substr(2);
  if (!std::all_of(digits.begin(), digits.end(), [](char c) { return c >= '0' && c <= '9'; }))
    return std::nullopt;
  for (const auto& [kind, name] : kNames) {
    if (!echo.starts_with(name)) continue;
    StreamRequest request;
    request.kind = kind;
    request.start = static_cast<std::uint16_t>(read_digits(digits.substr(0, 4)));
    request.end = static_cast<std::uint16_t>(read_digits(digits.substr(4, 4)));
    request.cluster = static_cast<std::uint8_t>(read_digits(digits.substr(8, 2)));
    request.interval = static_cast<std::uint8_t>(read_digits(digits.substr(10, 1)));
    request.count = static_cast<std::uint8_t>(read_digits(digits.substr(11, 2)));
    return request;
  }
  return std::nullopt;
}

}  // namespace topo::hokuyo
