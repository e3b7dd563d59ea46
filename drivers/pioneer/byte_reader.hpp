// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace topo::pioneer {

/// Reads little-endian fields from the front of a payload. Fields may be missing at the end (older firmware):
/// a read beyond the end returns nothing, and so does every read after it.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::byte> bytes) : rest_(bytes) {}

  [[nodiscard]] std::size_t remaining() const { return rest_.size(); }
  std::optional<std::uint8_t> u8() {
    if (rest_.empty()) return std::nullopt;
    const auto v = std::to_integer<std::uint8_t>(rest_[0]);
    rest_ = rest_.subspan(1);
    return v;
  }
  std::optional<std::uint16_t> u16() {
    if (rest_.size() < 2) {
      rest_ = {};
      return std::nullopt;
    }
    const auto v = static_cast<std::uint16_t>(std::to_integer<unsigned>(rest_[0]) |
                                              std::to_integer<unsigned>(rest_[1]) << 8U);
    rest_ = rest_.subspan(2);
    return v;
  }
  std::optional<std::int16_t> i16() {
    const auto v = u16();
    if (!v) return std::nullopt;
    return static_cast<std::int16_t>(*v);
  }
  std::optional<std::int8_t> i8() {
    const auto v = u8();
    if (!v) return std::nullopt;
    return static_cast<std::int8_t>(*v);
  }
  /// Text up to the NUL, which is consumed, or up to the end. Bytes other than printable ASCII become '?', so
  /// that names can be used in messages.
  std::string text() {
    std::string out;
    while (const auto c = u8()) {
      if (*c == 0) break;
      out.push_back(*c >= 0x20 && *c < 0x7F ? static_cast<char>(*c) : '?');
    }
    return out;
  }

 private:
  std::span<const std::byte> rest_;
};

}  // namespace topo::pioneer
