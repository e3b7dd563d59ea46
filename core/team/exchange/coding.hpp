// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/team/exchange/pieces.hpp"

// Two pieces in one datagram of the size of one: their bytes by exclusive or. Of two mates that lost
// different pieces each has the other one's, and gets its own from it (Katti et al., XORs in the Air, SIGCOMM
// 2006). With two mates that lose 30 % each, a piece is sent 1.43 times in place of 1.76.
namespace topo::team {

struct CodedPiece {
  PieceHead a, b;
  std::vector<std::byte> payload;  ///< of the length of the longer one
};

[[nodiscard]] std::vector<std::byte> encode_coded(const PieceHead& a, std::span<const std::byte> a_bytes,
                                                  const PieceHead& b, std::span<const std::byte> b_bytes);
/// Nothing for malformed bytes.
[[nodiscard]] std::optional<CodedPiece> decode_coded(std::span<const std::byte> bytes);
/// The bytes of a piece of `size` bytes, by those of the other.
[[nodiscard]] std::vector<std::byte> uncoded(const CodedPiece& coded, std::span<const std::byte> other,
                                             std::size_t size);

}  // namespace topo::team
