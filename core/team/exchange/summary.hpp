// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/team/exchange/item_store.hpp"

// What a robot says that it holds.
namespace topo::team {

/// Bits of a summary: the numbers from the first gap on that it speaks of.
inline constexpr std::uint32_t kSummaryBits = 256;

/// What is held of a stream.
struct StreamSummary {
  StreamKey key;
  std::uint32_t first_gap = 0;  ///< numbers below are held, this one is not
  std::uint32_t count = 0;      ///< items held
  std::uint32_t end = 0;        ///< the greatest number held plus one
  /// Bit i: number first_gap + 1 + i is held. What is held beyond is not told.
  std::vector<std::byte> bitmap;

  [[nodiscard]] bool holds(std::uint32_t number) const;
};

/// The streams of one summary message; with many streams several messages describe all.
struct Summary {
  std::uint64_t hash = 0;   ///< ItemStore::hash
  std::uint32_t items = 0;  ///< ItemStore::size
  std::vector<StreamSummary> streams;
};

[[nodiscard]] StreamSummary summary_of(const StreamKey& key, const ItemStream& stream);

/// Summary messages of all streams, each body at most kBodyBytesMax.
[[nodiscard]] std::vector<std::vector<std::byte>> encode_summaries(const ItemStore& store);
/// Nothing for malformed bytes.
[[nodiscard]] std::optional<Summary> decode_summary(std::span<const std::byte> bytes);

}  // namespace topo::team
