// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/team/exchange/assemblies.hpp"

#include <algorithm>
#include <utility>

namespace topo::team {
namespace {

/// Pieces of other bytes than those begun with are refused while as many pieces of anything come: then what
/// was begun with is dead, and gives way.
constexpr std::uint64_t kStaleTouches = 1'000;

}  // namespace

Piece Assemblies::add(const PieceHead& head, std::span<const std::byte> payload) {
  ++touches_;
  auto at = items_.find(head.key);
  if (at != items_.end() && (at->second.bytes.size() != head.total || at->second.check != head.check)) {
    if (touches_ - at->second.touched < kStaleTouches) return Piece::kOtherBytes;
    erase(head.key);
    at = items_.end();
  }
  if (at == items_.end()) {
    at =
        items_.emplace(head.key, Assembly{std::vector<std::byte>(head.total), head.check, 0, touches_}).first;
    bytes_ += head.total;
  }
  Assembly& assembly = at->second;
  const PieceBits bit = PieceBits{1} << head.index;
  assembly.touched = touches_;
  if ((assembly.held & bit) != 0) return Piece::kHeld;
  const PieceSpan span = span_of(head.total, head.index);
  std::copy_n(payload.begin(), span.size, assembly.bytes.begin() + static_cast<std::ptrdiff_t>(span.begin));
  assembly.held |= bit;
  make_room();
  return Piece::kTaken;
}

std::optional<std::vector<std::byte>> Assemblies::take_complete(const ItemKey& key) {
  const auto at = items_.find(key);
  if (at == items_.end() || at->second.held != bits_of(at->second.bytes.size())) return std::nullopt;
  std::vector<std::byte> bytes = std::move(at->second.bytes);
  bytes_ -= bytes.size();
  items_.erase(at);
  return bytes;
}

void Assemblies::erase(const ItemKey& key) {
  const auto at = items_.find(key);
  if (at == items_.end()) return;
  bytes_ -= at->second.bytes.size();
  items_.erase(at);
}

PieceBits Assemblies::lacking(const ItemKey& key) const {
  const auto at = items_.find(key);
  return at == items_.end() ? kAllPieces : bits_of(at->second.bytes.size()) & ~at->second.held;
}

std::span<const std::byte> Assemblies::find(const PieceHead& head) const {
  const auto at = items_.find(head.key);
  if (at == items_.end()) return {};
  const Assembly& assembly = at->second;
  const bool there = assembly.bytes.size() == head.total && assembly.check == head.check &&
                     (assembly.held >> head.index & 1U) != 0;
  return there ? piece_of(assembly.bytes, head.index) : std::span<const std::byte>{};
}

void Assemblies::make_room() {
  while (bytes_ > bytes_max_ && items_.size() > 1) {
    const auto oldest = std::min_element(items_.begin(), items_.end(), [](const auto& a, const auto& b) {
      return a.second.touched < b.second.touched;
    });
    bytes_ -= oldest->second.bytes.size();
    items_.erase(oldest);
  }
}

}  // namespace topo::team
