// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/team/exchange/coding.hpp"

#include <algorithm>

namespace topo::team {
namespace {

/// Exclusive or of bytes of which the shorter ones are followed by zeros, in `size` bytes.
std::vector<std::byte> combined(std::span<const std::byte> a, std::span<const std::byte> b,
                                std::size_t size) {
  std::vector<std::byte> out(size, std::byte{0});
  for (std::size_t i = 0; i < std::min(size, a.size()); ++i) out[i] = a[i];
  for (std::size_t i = 0; i < std::min(size, b.size()); ++i) out[i] ^= b[i];
  return out;
}

}  // namespace

std::vector<std::byte> encode_coded(const PieceHead& a, std::span<const std::byte> a_bytes,
                                    const PieceHead& b, std::span<const std::byte> b_bytes) {
  types::ByteWriter out;
  write_piece_head(out, a);
  write_piece_head(out, b);
  out.append(combined(a_bytes, b_bytes, std::max(a_bytes.size(), b_bytes.size())));
  return out.take();
}

std::optional<CodedPiece> decode_coded(std::span<const std::byte> bytes) {
  types::ByteReader in(bytes);
  bool ok = true;
  CodedPiece coded;
  coded.a = read_piece_head(in, ok);
  coded.b = ok ? read_piece_head(in, ok) : PieceHead{};
  if (!ok) return std::nullopt;
  const std::size_t size =
      std::max(span_of(coded.a.total, coded.a.index).size, span_of(coded.b.total, coded.b.index).size);
  if (in.remaining() != size) return std::nullopt;
  const auto payload = bytes.subspan(bytes.size() - size);
  coded.payload.assign(payload.begin(), payload.end());
  return coded;
}

std::vector<std::byte> uncoded(const CodedPiece& coded, std::span<const std::byte> other, std::size_t size) {
  return combined(coded.payload, other, size);
}

}  // namespace topo::team
