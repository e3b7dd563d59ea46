// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

namespace topo::daemon {

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

}  // namespace topo::daemon
