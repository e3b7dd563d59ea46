// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/skeleton/sparse_scan.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cstdint>
#include <vector>

#include "core/places/skeleton/cell_numbers.hpp"

namespace topo::places {
namespace {

template <class T>
void check_scan() {
  const auto bits = static_cast<T>(1U << *rc::gen::inRange<std::size_t>(0, 8 * sizeof(T)));
  // Around whole words, and whole groups of them.
  std::vector<T> values(*rc::gen::inRange<std::size_t>(0, 150), T{0});
  const int rare = *rc::gen::element(1, 4, 60);
  for (T& value : values)
    if (*rc::gen::inRange(0, rare) == 0)
      value = static_cast<T>(*rc::gen::inRange(0U, 1U << (8U * sizeof(T))));
  std::vector<std::size_t> expected, found;
  for (std::size_t i = 0; i < values.size(); ++i)
    if ((values[i] & bits) != 0) expected.push_back(i);
  for_each_with<T>(bits, values, [&](std::size_t i) { found.push_back(i); });
  RC_ASSERT(found == expected);
}

TEST(SparseScan, FindsBytesWithABitInRisingOrder) {
  EXPECT_TRUE(rc::check([] { check_scan<std::uint8_t>(); }));
}

TEST(SparseScan, FindsWordsWithABitInRisingOrder) {
  EXPECT_TRUE(rc::check([] { check_scan<std::uint16_t>(); }));
}

TEST(CellNumbers, AreThoseThatWereSetAndElseZero) {
  EXPECT_TRUE(rc::check([] {
    const auto count = *rc::gen::inRange<std::uint32_t>(1, 200);
    CellNumbers numbers(count);
    std::vector<std::uint32_t> expected(count, 0);
    for (int k = *rc::gen::inRange(0, 60); k > 0; --k) {
      const auto cell = *rc::gen::inRange<std::uint32_t>(0, count);
      expected[cell] = *rc::gen::inRange<std::uint32_t>(0, 1000);
      numbers.set(cell, expected[cell]);
    }
    for (std::uint32_t cell = 0; cell < count; ++cell) RC_ASSERT(numbers.at(cell) == expected[cell]);
  }));
}

}  // namespace
}  // namespace topo::places
