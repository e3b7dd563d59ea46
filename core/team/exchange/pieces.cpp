// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/team/exchange/pieces.hpp"

#include <algorithm>

#include "core/team/exchange/item_store.hpp"
#include "core/team/exchange/wire.hpp"

namespace topo::team {

std::size_t pieces_of(std::size_t bytes) { return (bytes + kPieceBytesMax - 1) / kPieceBytesMax; }

PieceBits bits_of(std::size_t bytes) {
  const std::size_t pieces = pieces_of(bytes);
  return pieces >= kPiecesMax ? kAllPieces : (PieceBits{1} << pieces) - 1;
}

PieceSpan span_of(std::size_t total, std::size_t index) {
  const std::size_t pieces = pieces_of(total), least = total / pieces, longer = total % pieces;
  return {index * least + std::min(index, longer), least + (index < longer ? 1 : 0)};
}

std::span<const std::byte> piece_of(std::span<const std::byte> bytes, std::size_t index) {
  const PieceSpan span = span_of(bytes.size(), index);
  return bytes.subspan(span.begin, span.size);
}

std::uint32_t check_of(std::span<const std::byte> bytes) {
  return static_cast<std::uint32_t>(hash_of(bytes) >> 32U);
}

PieceHead head_of(const ItemKey& key, std::span<const std::byte> bytes, std::size_t index) {
  return {key, static_cast<std::uint32_t>(bytes.size()), check_of(bytes), static_cast<std::uint8_t>(index)};
}

void write_piece_head(types::ByteWriter& out, const PieceHead& head) {
  write_origin(out, head.key.stream.origin);
  out.varint(head.key.number);
  out.varint(head.total);
  out.integer(head.check);
  out.integer(head.index);
}

PieceHead read_piece_head(types::ByteReader& in, bool& ok) {
  PieceHead head;
  head.key.stream = {ItemKind::kKeyframe, read_origin(in, ok)};
  const std::uint64_t number = in.varint(), total = in.varint();
  head.check = in.integer<std::uint32_t>();
  head.index = in.integer<std::uint8_t>();
  ok = ok && in.ok() && number < kNumbersMax && total > 0 && total <= kItemBytesMax &&
       head.index < pieces_of(total);
  if (!ok) return {};
  head.key.number = static_cast<std::uint32_t>(number);
  head.total = static_cast<std::uint32_t>(total);
  return head;
}

}  // namespace topo::team
