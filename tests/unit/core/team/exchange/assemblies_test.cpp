// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/team/exchange/assemblies.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>

#include "core/team/exchange/coding.hpp"
#include "core/team/exchange/wire.hpp"
#include "tests/unit/core/team/exchange/exchange_fixture.hpp"

namespace topo::team {
namespace {

const ItemKey kKey{{ItemKind::kKeyframe, {1, 1}}, 4}, kOther{{ItemKind::kKeyframe, {1, 1}}, 5};

std::vector<std::byte> item(std::size_t size, int seed = 0) {
  std::vector<std::byte> bytes(size);
  for (std::size_t i = 0; i < size; ++i)
    bytes[i] = static_cast<std::byte>((i * 31 + static_cast<std::size_t>(seed)) & 0xFFU);
  return bytes;
}

Piece add(Assemblies& to, const ItemKey& key, const std::vector<std::byte>& bytes, std::size_t index) {
  return to.add(head_of(key, bytes, index), piece_of(bytes, index));
}

TEST(Pieces, CoverAnItemWithoutOverlap) {
  EXPECT_TRUE(rc::check([] {
    const auto size = *rc::gen::inRange<std::size_t>(1, kItemBytesMax + 1);
    std::size_t next = 0;
    for (std::size_t i = 0; i < pieces_of(size); ++i) {
      const PieceSpan span = span_of(size, i);
      RC_ASSERT(span.begin == next);
      RC_ASSERT(span.size > 0U);
      RC_ASSERT(span.size <= kPieceBytesMax);
      next += span.size;
    }
    RC_ASSERT(next == size);
    RC_ASSERT(pieces_of(size) <= kPiecesMax);
  }));
}

TEST(Pieces, AHeadIsReadAsWritten) {
  const auto bytes = item(5'000);
  const PieceHead head = head_of(kKey, bytes, 4);
  types::ByteWriter out;
  write_piece_head(out, head);
  types::ByteReader in(out.bytes());
  bool ok = true;
  EXPECT_EQ(read_piece_head(in, ok), head);
  EXPECT_TRUE(ok && in.complete());
}

TEST(Pieces, HeadsOfNoPieceAreRefused) {
  const auto refused = [](std::uint32_t total, std::uint8_t index) {
    types::ByteWriter out;
    write_piece_head(out, {kKey, total, 1, index});
    types::ByteReader in(out.bytes());
    bool ok = true;
    (void)read_piece_head(in, ok);
    return !ok;
  };
  EXPECT_TRUE(refused(0, 0));
  EXPECT_TRUE(refused(kItemBytesMax + 1, 0));
  EXPECT_TRUE(refused(2'000, 2));
  EXPECT_FALSE(refused(2'000, 1));
}

TEST(Assemblies, PiecesInAnyOrderMakeTheItem) {
  Assemblies assemblies(100'000);
  const auto bytes = item(4'000);
  for (const std::size_t index : {3U, 0U, 2U}) EXPECT_EQ(add(assemblies, kKey, bytes, index), Piece::kTaken);
  EXPECT_EQ(add(assemblies, kKey, bytes, 2), Piece::kHeld);
  EXPECT_EQ(assemblies.lacking(kKey), 0b10U);
  EXPECT_FALSE(assemblies.take_complete(kKey));
  add(assemblies, kKey, bytes, 1);
  const auto complete = assemblies.take_complete(kKey);
  ASSERT_TRUE(complete);
  EXPECT_EQ(*complete, bytes);
  EXPECT_EQ(assemblies.bytes(), 0U);
  EXPECT_EQ(assemblies.lacking(kKey), kAllPieces);
}

TEST(Assemblies, PiecesOfOtherBytesAreNotMixed) {
  Assemblies assemblies(100'000);
  add(assemblies, kKey, item(4'000), 0);
  EXPECT_EQ(add(assemblies, kKey, item(4'000, 1), 1), Piece::kOtherBytes);
  EXPECT_EQ(add(assemblies, kKey, item(3'999), 1), Piece::kOtherBytes);
}

TEST(Assemblies, WhatWasBegunAndDiedGivesWay) {
  Assemblies assemblies(100'000);
  add(assemblies, kKey, item(4'000), 0);
  for (int i = 0; i < 1'000; ++i) add(assemblies, kOther, item(4'000), 0);
  EXPECT_EQ(add(assemblies, kKey, item(4'000, 1), 1), Piece::kTaken);
}

TEST(Assemblies, TheLongestUntouchedGoesWhenItIsFull) {
  Assemblies assemblies(9'000);
  add(assemblies, kKey, item(4'000), 0);
  add(assemblies, kOther, item(4'000), 0);
  add(assemblies, kKey, item(4'000), 1);
  add(assemblies, {kKey.stream, 6}, item(4'000), 0);
  EXPECT_LE(assemblies.bytes(), 9'000U);
  EXPECT_EQ(assemblies.lacking(kOther), kAllPieces) << "this one went";
  EXPECT_EQ(assemblies.lacking(kKey), 0b1100U);
}

TEST(Assemblies, APieceIsFoundByItsHead) {
  Assemblies assemblies(100'000);
  const auto bytes = item(4'000);
  add(assemblies, kKey, bytes, 2);
  EXPECT_TRUE(std::ranges::equal(assemblies.find(head_of(kKey, bytes, 2)), piece_of(bytes, 2)));
  EXPECT_TRUE(assemblies.find(head_of(kKey, bytes, 1)).empty());
  EXPECT_TRUE(assemblies.find(head_of(kKey, item(4'000, 1), 2)).empty());
  assemblies.erase(kKey);
  EXPECT_EQ(assemblies.bytes(), 0U);
}

TEST(Coding, EachPieceComesOutByTheOther) {
  EXPECT_TRUE(rc::check([] {
    const auto a = item(*rc::gen::inRange<std::size_t>(1, 3'000), 1),
               b = item(*rc::gen::inRange<std::size_t>(1, 3'000), 2);
    const auto body =
        encode_coded(head_of(kKey, a, 0), piece_of(a, 0), head_of(kOther, b, 0), piece_of(b, 0));
    RC_ASSERT(body.size() <= kBodyBytesMax);
    const auto coded = decode_coded(body);
    RC_ASSERT(coded.has_value());
    RC_ASSERT(std::ranges::equal(uncoded(*coded, piece_of(b, 0), piece_of(a, 0).size()), piece_of(a, 0)));
    RC_ASSERT(std::ranges::equal(uncoded(*coded, piece_of(a, 0), piece_of(b, 0).size()), piece_of(b, 0)));
  }));
}

TEST(Coding, TheLargestFitInADatagram) {
  const auto bytes = item(kItemBytesMax);
  const ItemKey last{{ItemKind::kKeyframe, {65'535, 0xFFFF'FFFFU}}, kNumbersMax - 1};
  const PieceHead head = head_of(last, bytes, pieces_of(bytes.size()) - 1);
  const std::vector<std::byte> payload(kPieceBytesMax);
  EXPECT_LE(encode_coded(head, payload, head, payload).size(), kBodyBytesMax);
}

TEST(Coding, OtherLengthsAreRefused) {
  const auto a = item(1'000), b = item(900);
  auto body = encode_coded(head_of(kKey, a, 0), a, head_of(kOther, b, 0), b);
  EXPECT_TRUE(decode_coded(body));
  body.push_back(std::byte{0});
  EXPECT_FALSE(decode_coded(body));
  for (const std::size_t size : {std::size_t{0}, std::size_t{9}, body.size() - 2})
    EXPECT_FALSE(decode_coded(std::span(body).first(size))) << size;
}

}  // namespace
}  // namespace topo::team
