// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/types/bytes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "tests/unit/support/hex.hpp"

namespace topo::types {
namespace {

using test::from_hex;
using test::to_bytes;

template <class Write>
std::vector<std::byte> written(Write&& write) {
  ByteWriter out;
  write(out);
  return out.take();
}

template <class Integer>
void expect_extremes_come_back() {
  using Limits = std::numeric_limits<Integer>;
  for (const Integer value : {Limits::min(), Limits::max(), Integer{0}, Integer{1}, static_cast<Integer>(-1),
                              static_cast<Integer>(Limits::max() / 3)}) {
    const auto bytes = written([&](ByteWriter& out) { out.integer(value); });
    EXPECT_EQ(bytes.size(), sizeof(Integer));
    ByteReader in(bytes);
    EXPECT_EQ(in.integer<Integer>(), value);
    EXPECT_TRUE(in.complete());
  }
}

TEST(Bytes, IntegersOfAllWidthsComeBack) {
  expect_extremes_come_back<std::uint8_t>();
  expect_extremes_come_back<std::int8_t>();
  expect_extremes_come_back<std::uint16_t>();
  expect_extremes_come_back<std::int16_t>();
  expect_extremes_come_back<std::uint32_t>();
  expect_extremes_come_back<std::int32_t>();
  expect_extremes_come_back<std::uint64_t>();
  expect_extremes_come_back<std::int64_t>();
}

TEST(Bytes, TheLowestByteComesFirst) {
  EXPECT_EQ(written([](ByteWriter& out) { out.integer(std::uint32_t{0x01020304}); }),
            from_hex("04 03 02 01"));
  EXPECT_EQ(written([](ByteWriter& out) { out.integer(std::int16_t{-2}); }), from_hex("fe ff"));
  // IEEE 754: 1 is 0x3f800000 and 0x3ff0000000000000.
  EXPECT_EQ(written([](ByteWriter& out) { out.real(1.0F); }), from_hex("00 00 80 3f"));
  EXPECT_EQ(written([](ByteWriter& out) { out.real(1.0); }), from_hex("00 00 00 00 00 00 f0 3f"));
}

TEST(Bytes, RealsComeBackToTheBit) {
  using Limits = std::numeric_limits<double>;
  for (const double value : {0.0, -0.0, 1.0 / 3.0, Limits::max(), Limits::denorm_min(), -Limits::infinity(),
                             Limits::quiet_NaN(), -1e-300}) {
    const auto bytes = written([&](ByteWriter& out) {
      out.real(value);
      out.real(static_cast<float>(value));
    });
    ByteReader in(bytes);
    EXPECT_EQ(std::bit_cast<std::uint64_t>(in.real64()), std::bit_cast<std::uint64_t>(value));
    EXPECT_EQ(std::bit_cast<std::uint32_t>(in.real32()),
              std::bit_cast<std::uint32_t>(static_cast<float>(value)));
    EXPECT_TRUE(in.complete());
  }
}

TEST(Bytes, AVarintTakesAByteForEverySevenBits) {
  for (unsigned bits = 0; bits <= 64; ++bits) {
    const std::uint64_t most = bits == 64 ? UINT64_MAX : (std::uint64_t{1} << bits) - 1;
    const auto bytes = written([&](ByteWriter& out) { out.varint(most); });
    EXPECT_EQ(bytes.size(), std::max(1U, (bits + 6) / 7)) << bits;
    ByteReader in(bytes);
    EXPECT_EQ(in.varint(), most);
    EXPECT_TRUE(in.complete());
  }
  // The example of DWARF 5, figure 20.
  EXPECT_EQ(written([](ByteWriter& out) { out.varint(12857); }), from_hex("b9 64"));
}

TEST(Bytes, NumbersNearZeroOfEitherSignAreShort) {
  const std::vector<std::int64_t> values{0, -1, 1, -2, 2, -64};
  const std::vector<std::uint64_t> expected{0, 1, 2, 3, 4, 127};
  for (std::size_t i = 0; i < values.size(); ++i) {
    EXPECT_EQ(written([&](ByteWriter& out) { out.zigzag(values[i]); }),
              written([&](ByteWriter& out) { out.varint(expected[i]); }));
  }
  for (const std::int64_t value :
       {INT64_MIN, INT64_MIN + 1, INT64_MAX, std::int64_t{-65}, std::int64_t{64}}) {
    const auto bytes = written([&](ByteWriter& out) { out.zigzag(value); });
    ByteReader in(bytes);
    EXPECT_EQ(in.zigzag(), value);
    EXPECT_TRUE(in.complete());
  }
}

TEST(ByteReader, BeyondTheEndEverythingIsZeroForGood) {
  const auto bytes = from_hex("01 02 03");
  const std::vector<std::function<double(ByteReader&)>> reads{
      [](ByteReader& in) { return static_cast<double>(in.integer<std::uint32_t>()); },
      [](ByteReader& in) { return static_cast<double>(in.integer<std::int64_t>()); },
      [](ByteReader& in) { return in.real64(); }, [](ByteReader& in) { return double{in.real32()}; }};
  for (const auto& read : reads) {
    ByteReader in(bytes);
    EXPECT_EQ(read(in), 0.0);
    EXPECT_FALSE(in.ok());
    EXPECT_EQ(in.remaining(), 0U) << "what was too short for one field is not read as another";
    EXPECT_EQ(in.integer<std::uint8_t>(), 0U);
    EXPECT_EQ(in.varint(), 0U);
    EXPECT_EQ(in.zigzag(), 0);
    EXPECT_EQ(in.count(1), 0U);
    EXPECT_FALSE(in.ok());
    EXPECT_FALSE(in.complete());
  }
}

TEST(ByteReader, IsCompleteOnlyWhenNothingIsLeft) {
  const auto bytes = from_hex("01 02");
  ByteReader in(bytes);
  EXPECT_EQ(in.integer<std::uint8_t>(), 1U);
  EXPECT_TRUE(in.ok());
  EXPECT_FALSE(in.complete());
  EXPECT_EQ(in.remaining(), 1U);
  EXPECT_EQ(in.integer<std::uint8_t>(), 2U);
  EXPECT_TRUE(in.complete());
}

TEST(ByteReader, AVarintWithoutAnEndIsRefused) {
  for (const std::size_t length : {1U, 5U, 9U, 10U, 11U, 40U}) {
    const std::vector<std::byte> bytes(length, std::byte{0x80});
    ByteReader in(bytes);
    EXPECT_EQ(in.varint(), 0U);
    EXPECT_FALSE(in.ok()) << length;
  }
}

TEST(ByteReader, ACountThatTheBytesCannotHoldIsRefused) {
  for (std::size_t held = 0; held < 30; ++held) {
    for (const std::size_t each : {1U, 2U, 7U}) {
      for (std::uint64_t claimed = 0; claimed < 30; ++claimed) {
        const auto bytes = written([&](ByteWriter& out) {
          out.varint(claimed);
          out.append(std::vector<std::byte>(held));
        });
        ByteReader in(bytes);
        const bool fits = claimed * each <= held;
        EXPECT_EQ(in.count(each), fits ? claimed : 0U);
        EXPECT_EQ(in.ok(), fits) << claimed << " of " << each << " in " << held;
      }
    }
  }
  const auto huge = written([](ByteWriter& out) { out.varint(UINT64_MAX); });
  ByteReader in(huge);
  EXPECT_EQ(in.count(8), 0U);
  EXPECT_FALSE(in.ok());
}

/// Fields of random kinds, as numbers.
std::vector<std::pair<unsigned, std::int64_t>> random_fields(std::mt19937_64& random) {
  std::vector<std::pair<unsigned, std::int64_t>> fields;
  for (std::size_t k = 1 + random() % 12; k > 0; --k)
    fields.emplace_back(random() % 4, static_cast<std::int64_t>(random() >> random() % 64));
  return fields;
}

TEST(ByteReader, FieldsComeBackAndNoPartOfThemIsWhole) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    std::mt19937_64 random(seed);
    const auto fields = random_fields(random);
    const auto bytes = written([&](ByteWriter& out) {
      for (const auto& [kind, value] : fields) {
        if (kind == 0) out.integer(value);
        if (kind == 1) out.integer(static_cast<std::uint16_t>(value));
        if (kind == 2) out.varint(static_cast<std::uint64_t>(value));
        if (kind == 3) out.zigzag(value);
      }
    });
    for (std::size_t length = 0; length <= bytes.size(); ++length) {
      ByteReader in(std::span<const std::byte>(bytes).first(length));
      bool same = true;
      for (const auto& [kind, value] : fields) {
        if (kind == 0) same &= in.integer<std::int64_t>() == value;
        if (kind == 1) same &= in.integer<std::uint16_t>() == static_cast<std::uint16_t>(value);
        if (kind == 2) same &= in.varint() == static_cast<std::uint64_t>(value);
        if (kind == 3) same &= in.zigzag() == value;
      }
      EXPECT_EQ(in.complete(), length == bytes.size()) << seed;
      EXPECT_TRUE(same || length < bytes.size()) << seed;
    }
  }
}

}  // namespace
}  // namespace topo::types
