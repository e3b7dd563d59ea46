// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <span>
#include <vector>

#include "core/team/exchange/assemblies.hpp"
#include "core/team/exchange/item_store.hpp"
#include "core/team/exchange/params.hpp"
#include "core/team/exchange/summary.hpp"

// What a robot asks of another. Wants replace those before; nobody keeps account of what was answered.
namespace topo::team {

/// Items of one stream in a row that are wanted whole, or one of which some pieces are wanted.
struct WantRun {
  std::uint32_t first = 0;
  std::uint32_t count = 1;
  PieceBits pieces = kAllPieces;
  [[nodiscard]] bool covers(std::uint32_t number) const { return number >= first && number - first < count; }
  friend bool operator==(const WantRun&, const WantRun&) = default;
};

struct StreamWants {
  StreamKey key;
  /// Of the numbers below, what is not wanted is held; 0: not told.
  std::uint32_t covered = 0;
  std::vector<WantRun> runs;  ///< ascending, apart from one another
  friend bool operator==(const StreamWants&, const StreamWants&) = default;
};

struct WantList {
  slam::Origin to;  ///< who is asked
  std::uint32_t heard =
      0;  ///< the newest datagram from there when this was written: what was sent later may come yet
  std::vector<StreamWants> streams;
};

/// One from whom items can be had.
struct Source {
  slam::Origin peer;
  const std::map<StreamKey, StreamSummary>* holds = nullptr;
};

/// What is lacking here and held by a source, by the source that is asked for it: the origin itself where it
/// is one, else one that is drawn by the item's key, so that sources share the work. `self` made all its own
/// items.
[[nodiscard]] std::map<slam::Origin, std::vector<StreamWants>> find_wants(const slam::Origin& self,
                                                                          const ItemStore& store,
                                                                          const Assemblies& assemblies,
                                                                          std::span<const Source> sources,
                                                                          const CapParams& caps);

/// As much of the list as fits in kBodyBytesMax, first streams first.
[[nodiscard]] std::vector<std::byte> encode_wants(const WantList& list);
/// Nothing for malformed bytes.
[[nodiscard]] std::optional<WantList> decode_wants(std::span<const std::byte> bytes);

}  // namespace topo::team
