// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

#include "core/slam/keyframe.hpp"

// What the robots of a team share, as bytes: immutable items, each under a key. Kind, origin and number make
// the key; the holder of an item is of no consequence, so that an item of one robot reaches a third through a
// second.
namespace topo::team {

enum class ItemKind : std::uint8_t {
  kLog = 0,       ///< log_entry.hpp: small, and before all others
  kRelation = 1,  ///< slam::FoundRelation
  kKeyframe = 2,  ///< slam::encode_keyframe
};
inline constexpr std::uint8_t kItemKinds = 3;

/// The items of one kind that one robot made in one run of its program, numbered from 0 without gaps.
struct StreamKey {
  ItemKind kind = ItemKind::kLog;
  slam::Origin origin;
  friend auto operator<=>(const StreamKey&, const StreamKey&) = default;
};

struct ItemKey {
  StreamKey stream;
  std::uint32_t number = 0;
  friend auto operator<=>(const ItemKey&, const ItemKey&) = default;
};

/// The encoded item; copies of the exchange share it.
using ItemBytes = std::shared_ptr<const std::vector<std::byte>>;

/// Numbers are below this: 12 days of one item a second. A peer that claims more is malformed.
inline constexpr std::uint32_t kNumbersMax = 1U << 20U;
/// Larger items are refused: an encoded keyframe of a scanner with 1081 beams is below a quarter of it.
inline constexpr std::size_t kItemBytesMax = 65'536;
/// Log entries and relations are at most so long, so that one fits in one datagram.
inline constexpr std::size_t kSmallItemBytesMax = 1'000;

}  // namespace topo::team
