// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "core/team/exchange/pieces.hpp"

namespace topo::team {

/// What became of a piece.
enum class Piece : std::uint8_t {
  kTaken,
  kHeld,        ///< it was there
  kOtherBytes,  ///< of an item that is being assembled from other bytes
};

/// Items of which some pieces are there. Bounded: when the bytes exceed the cap, what was not touched for
/// longest goes, and is wanted anew. Value semantics.
class Assemblies {
 public:
  explicit Assemblies(std::size_t bytes_max) : bytes_max_(bytes_max) {}

  /// Precondition: `payload` has the size that the head implies.
  Piece add(const PieceHead& head, std::span<const std::byte> payload);
  /// The bytes of an item whose pieces are all there, which leaves the assemblies.
  [[nodiscard]] std::optional<std::vector<std::byte>> take_complete(const ItemKey& key);
  void erase(const ItemKey& key);

  /// Pieces that are missing; all when nothing is there.
  [[nodiscard]] PieceBits lacking(const ItemKey& key) const;
  /// The bytes of a piece that is there; empty when it is not, or when it is of other bytes.
  [[nodiscard]] std::span<const std::byte> find(const PieceHead& head) const;
  [[nodiscard]] std::size_t bytes() const { return bytes_; }

 private:
  struct Assembly {
    std::vector<std::byte> bytes;
    std::uint32_t check = 0;
    PieceBits held = 0;
    std::uint64_t touched = 0;
  };
  void make_room();

  std::size_t bytes_max_;
  std::map<ItemKey, Assembly> items_;
  std::size_t bytes_ = 0;
  std::uint64_t touches_ = 0;
};

}  // namespace topo::team
