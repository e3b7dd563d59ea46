// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "core/team/exchange/item.hpp"
#include "core/types/bytes.hpp"

// A keyframe is larger than a datagram and goes in pieces of equal size; a piece that is lost is wanted
// alone.
namespace topo::team {

/// Fits into a datagram beside the heads of two pieces (a coded piece, coding.hpp).
inline constexpr std::size_t kPieceBytesMax = 1'140;
inline constexpr std::size_t kPiecesMax = 64;  ///< bits of PieceBits
static_assert(kItemBytesMax <= kPieceBytesMax * kPiecesMax);

/// A bit for each piece of an item.
using PieceBits = std::uint64_t;
inline constexpr PieceBits kAllPieces = ~PieceBits{0};

/// How many pieces an item of so many bytes has; 0 for none.
[[nodiscard]] std::size_t pieces_of(std::size_t bytes);
/// The bits of all of them.
[[nodiscard]] PieceBits bits_of(std::size_t bytes);

/// What says which piece of which item it is.
struct PieceHead {
  ItemKey key;
  std::uint32_t total = 0;  ///< bytes of the item
  std::uint32_t check = 0;  ///< of all its bytes: pieces of different bytes are not mixed
  std::uint8_t index = 0;
  friend bool operator==(const PieceHead&, const PieceHead&) = default;
};

/// Where a piece begins in the item, and its size.
struct PieceSpan {
  std::size_t begin = 0, size = 0;
};
[[nodiscard]] PieceSpan span_of(std::size_t total, std::size_t index);

/// The part of an item's bytes that a piece has. Precondition: index < pieces_of(bytes.size()).
[[nodiscard]] std::span<const std::byte> piece_of(std::span<const std::byte> bytes, std::size_t index);
[[nodiscard]] std::uint32_t check_of(std::span<const std::byte> bytes);
[[nodiscard]] PieceHead head_of(const ItemKey& key, std::span<const std::byte> bytes, std::size_t index);

/// A coded piece has two heads, a plain one one; then the bytes.
void write_piece_head(types::ByteWriter& out, const PieceHead& head);
/// `ok` becomes false when it is no piece of a keyframe.
[[nodiscard]] PieceHead read_piece_head(types::ByteReader& in, bool& ok);

}  // namespace topo::team
