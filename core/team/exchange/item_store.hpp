// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <span>
#include <vector>

#include "core/team/exchange/item.hpp"

namespace topo::team {

/// A hash over bytes, the same on every machine. It does not resist forgery, which the carrier prevents.
[[nodiscard]] std::uint64_t hash_of(std::span<const std::byte> bytes);

/// What is held of a stream.
class ItemStream {
 public:
  /// Numbers below are all held.
  [[nodiscard]] std::uint32_t first_gap() const { return first_gap_; }
  [[nodiscard]] bool contains(std::uint32_t number) const { return items_.contains(number); }
  /// The greatest number held plus one; 0: none.
  [[nodiscard]] std::uint32_t end() const { return items_.empty() ? 0 : items_.rbegin()->first + 1; }
  [[nodiscard]] const std::map<std::uint32_t, ItemBytes>& items() const { return items_; }
  [[nodiscard]] std::size_t bytes() const { return bytes_; }

 private:
  friend class ItemStore;
  std::map<std::uint32_t, ItemBytes> items_;
  std::uint32_t first_gap_ = 0;
  std::size_t bytes_ = 0;
};

/// What became of an item.
enum class Stored : std::uint8_t {
  kNew,
  kHeld,      ///< it was there
  kReplaced,  ///< it was there with other bytes, which gave way: of two the lexicographically lower are kept
  kKept,      ///< it was there with other bytes, which stay
};

/// The grow-only set of all items, a join-semilattice as slam::KeyframeSet is. Value semantics; copies share
/// the bytes.
class ItemStore {
 public:
  /// `bytes` is not null.
  Stored insert(const ItemKey& key, const ItemBytes& bytes);
  /// Null when it is not held.
  [[nodiscard]] ItemBytes find(const ItemKey& key) const;
  [[nodiscard]] bool contains(const ItemKey& key) const;
  /// Null when nothing of it is held.
  [[nodiscard]] const ItemStream* stream(const StreamKey& key) const;
  [[nodiscard]] const std::map<StreamKey, ItemStream>& streams() const { return streams_; }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] std::size_t bytes() const { return bytes_; }
  /// Over keys and bytes of all items, whatever the order in which they came.
  [[nodiscard]] std::uint64_t hash() const { return hash_; }

 private:
  std::map<StreamKey, ItemStream> streams_;
  std::size_t size_ = 0;
  std::size_t bytes_ = 0;
  std::uint64_t hash_ = 0;
};

}  // namespace topo::team
