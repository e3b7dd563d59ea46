// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace topo::types {

/// Writes an integer at `at`; the caller ensures the space.
template <class Integer>
void store_le(std::span<std::byte> out, std::size_t at, Integer value) noexcept {
  const auto bits = static_cast<std::uint64_t>(static_cast<std::make_unsigned_t<Integer>>(value));
  for (std::size_t i = 0; i < sizeof(Integer); ++i)
    out[at + i] = static_cast<std::byte>((bits >> (8U * i)) & 0xFFU);
}

/// Reads an integer at `at`; the caller has checked the bounds.
template <class Integer>
[[nodiscard]] Integer load_le(std::span<const std::byte> in, std::size_t at) noexcept {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < sizeof(Integer); ++i)
    bits |= std::to_integer<std::uint64_t>(in[at + i]) << (8U * i);
  return static_cast<Integer>(bits);
}

/// Appends fields, little-endian, to a block of bytes.
class ByteWriter {
 public:
  template <class Integer>
  void integer(Integer value) {
    std::array<std::byte, sizeof(Integer)> field{};
    store_le<Integer>(field, 0, value);
    append(field);
  }
  void real(double value) { integer(std::bit_cast<std::uint64_t>(value)); }
  void real(float value) { integer(std::bit_cast<std::uint32_t>(value)); }
  /// Seven bits a byte, lowest first, the eighth says that more come (LEB128): small numbers are short.
  void varint(std::uint64_t value) {
    for (; value >= 0x80U; value >>= 7U) byte(value | 0x80U);
    byte(value);
  }
  /// Numbers near zero of either sign are short: 0, -1, 1, -2 ... become 0, 1, 2, 3 ...
  void zigzag(std::int64_t value) {
    varint((static_cast<std::uint64_t>(value) << 1U) ^ static_cast<std::uint64_t>(value >> 63));
  }

  void append(std::span<const std::byte> more) { bytes_.insert(bytes_.end(), more.begin(), more.end()); }

  [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_; }
  [[nodiscard]] std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  void byte(std::uint64_t bits) { bytes_.push_back(static_cast<std::byte>(bits & 0xFFU)); }
  std::vector<std::byte> bytes_;
};

/// Reads the fields of hostile bytes in their order. A read beyond the end returns zero and makes ok() false
/// for all later reads: one test of ok() at the end suffices, and nothing outside is ever read.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::byte> bytes) : rest_(bytes) {}

  template <class Integer>
  [[nodiscard]] Integer integer() {
    if (rest_.size() < sizeof(Integer)) return spoil<Integer>();
    const auto value = load_le<Integer>(rest_, 0);
    rest_ = rest_.subspan(sizeof(Integer));
    return value;
  }
  /// A field that may be missing at the end (older firmware): nothing, and nothing for every field after it.
  template <class Integer>
  std::optional<Integer> optional() {
    const auto value = integer<Integer>();
    return ok_ ? std::optional(value) : std::nullopt;
  }
  /// Text up to the NUL, which is consumed, or up to the end. Bytes other than printable ASCII become '?', so
  /// that names can be used in messages.
  [[nodiscard]] std::string text() {
    std::string out;
    while (const auto c = optional<std::uint8_t>()) {
      if (*c == 0) break;
      out.push_back(*c >= 0x20 && *c < 0x7F ? static_cast<char>(*c) : '?');
    }
    return out;
  }
  [[nodiscard]] double real64() { return std::bit_cast<double>(integer<std::uint64_t>()); }
  [[nodiscard]] float real32() { return std::bit_cast<float>(integer<std::uint32_t>()); }
  [[nodiscard]] std::uint64_t varint() {
    std::uint64_t value = 0;
    for (unsigned shift = 0; shift < 64; shift += 7) {
      const auto byte = integer<std::uint8_t>();
      value |= static_cast<std::uint64_t>(byte & 0x7FU) << shift;
      if ((byte & 0x80U) == 0) return value;
    }
    return spoil<std::uint64_t>();
  }
  [[nodiscard]] std::int64_t zigzag() {
    const std::uint64_t value = varint();
    return static_cast<std::int64_t>((value >> 1U) ^ (~(value & 1U) + 1U));
  }
  /// A number of elements that take at least `bytes_each` of what is left: a count that the bytes cannot hold
  /// makes ok() false, so that no memory is allocated by what a file claims.
  [[nodiscard]] std::size_t count(std::size_t bytes_each) {
    const std::uint64_t n = varint();
    if (n > rest_.size() / bytes_each) return spoil<std::size_t>();
    return static_cast<std::size_t>(n);
  }

  [[nodiscard]] std::size_t remaining() const { return rest_.size(); }
  [[nodiscard]] bool ok() const { return ok_; }
  /// True when every field was there and nothing is left over.
  [[nodiscard]] bool complete() const { return ok_ && rest_.empty(); }

 private:
  template <class Integer>
  Integer spoil() {
    ok_ = false;
    rest_ = {};
    return Integer{};
  }
  std::span<const std::byte> rest_;
  bool ok_ = true;
};

}  // namespace topo::types
