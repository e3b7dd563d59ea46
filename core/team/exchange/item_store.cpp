// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/team/exchange/item_store.hpp"

#include "core/types/bytes.hpp"

namespace topo::team {
namespace {

/// The finaliser of MurmurHash3 (Appleby): every bit of the input changes half of the output.
constexpr std::uint64_t mixed(std::uint64_t h) {
  h = (h ^ (h >> 33U)) * 0xFF51AFD7ED558CCDULL;
  h = (h ^ (h >> 33U)) * 0xC4CEB9FE1A85EC53ULL;
  return h ^ (h >> 33U);
}

std::uint64_t hash_of_item(const ItemKey& key, const ItemBytes& bytes) {
  std::uint64_t h = mixed(hash_of(*bytes));
  for (const std::uint64_t part :
       {static_cast<std::uint64_t>(key.stream.kind), static_cast<std::uint64_t>(key.stream.origin.robot),
        static_cast<std::uint64_t>(key.stream.origin.run), static_cast<std::uint64_t>(key.number)})
    h = mixed(h + part + 1U);
  return h;
}

}  // namespace

std::uint64_t hash_of(std::span<const std::byte> bytes) {
  std::uint64_t h = mixed(bytes.size() + 1U);
  std::size_t at = 0;
  for (; at + 8 <= bytes.size(); at += 8) h = mixed(h ^ types::load_le<std::uint64_t>(bytes, at));
  for (; at < bytes.size(); ++at) h = mixed(h ^ (std::to_integer<std::uint64_t>(bytes[at]) + 1U));
  return h;
}

Stored ItemStore::insert(const ItemKey& key, const ItemBytes& bytes) {
  ItemStream& stream = streams_[key.stream];
  const auto [at, added] = stream.items_.try_emplace(key.number, bytes);
  if (!added) {
    if (at->second == bytes || *at->second == *bytes) return Stored::kHeld;
    if (*at->second < *bytes) return Stored::kKept;
    // The hash is a sum, from which the item that gives way is taken back.
    hash_ -= hash_of_item(key, at->second);
    stream.bytes_ -= at->second->size();
    bytes_ -= at->second->size();
    at->second = bytes;
  }
  hash_ += hash_of_item(key, bytes);
  stream.bytes_ += bytes->size();
  bytes_ += bytes->size();
  if (!added) return Stored::kReplaced;
  ++size_;
  for (auto next = stream.items_.find(stream.first_gap_);
       next != stream.items_.end() && next->first == stream.first_gap_; ++next)
    ++stream.first_gap_;
  return Stored::kNew;
}

ItemBytes ItemStore::find(const ItemKey& key) const {
  const ItemStream* held = stream(key.stream);
  if (held == nullptr) return nullptr;
  const auto at = held->items().find(key.number);
  return at == held->items().end() ? nullptr : at->second;
}

bool ItemStore::contains(const ItemKey& key) const {
  const ItemStream* held = stream(key.stream);
  return held != nullptr && held->contains(key.number);
}

const ItemStream* ItemStore::stream(const StreamKey& key) const {
  const auto at = streams_.find(key);
  return at == streams_.end() ? nullptr : &at->second;
}

}  // namespace topo::team
