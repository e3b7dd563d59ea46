// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace topo::slam {

/// Appends little-endian fields to a block of bytes.
class ByteWriter {
 public:
  template <class Integer>
  void integer(Integer value) {
    auto bits = static_cast<std::uint64_t>(static_cast<std::make_unsigned_t<Integer>>(value));
    for (std::size_t i = 0; i < sizeof(Integer); ++i, bits >>= 8U) byte(bits);
  }
  void real(double value) { integer(std::bit_cast<std::uint64_t>(value)); }
  void real(float value) { integer(std::bit_cast<std::uint32_t>(value)); }
  /// LEB128: seven bits per byte, lowest first; the eighth bit is set when more bytes follow. Small numbers
  /// are short.
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

/// Reads fields in order from untrusted bytes. A read beyond the end returns zero and makes ok() false
/// permanently, so that the caller checks once, at the end; nothing is ever read out of bounds.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::byte> bytes) : rest_(bytes) {}

  template <class Integer>
  [[nodiscard]] Integer integer() {
    if (rest_.size() < sizeof(Integer)) return spoil<Integer>();
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < sizeof(Integer); ++i)
      bits |= std::to_integer<std::uint64_t>(rest_[i]) << (8U * i);
    rest_ = rest_.subspan(sizeof(Integer));
    return static_cast<Integer>(bits);
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
  /// Reads a number of elements, each of which takes at least `bytes_each` of the remaining bytes. A count
  /// that the bytes cannot hold makes ok() false, so that no memory is allocated by the claim of a file.
  [[nodiscard]] std::size_t count(std::size_t bytes_each) {
    const std::uint64_t n = varint();
    if (n > rest_.size() / bytes_each) return spoil<std::size_t>();
    return static_cast<std::size_t>(n);
  }

  [[nodiscard]] std::size_t remaining() const { return rest_.size(); }
  [[nodiscard]] bool ok() const { return ok_; }
  /// True when all reads succeeded and no bytes are left.
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

}  // namespace topo::slam
