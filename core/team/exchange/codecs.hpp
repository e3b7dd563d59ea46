// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/slam/relation_set.hpp"
#include "core/team/exchange/item.hpp"
#include "core/team/exchange/log_entry.hpp"
#include "core/team/status_message.hpp"
#include "core/types/result.hpp"

// What items and statuses look like as bytes. Each decode_ takes hostile bytes: kProtocol names the fault,
// and what it gives is finite and in range. Places reach 100 km, so that no cell number overflows.
namespace topo::team {

/// Of a relation without its id, which is in the item's key. The lower triangle of the information is that of
/// the upper one: symmetric to the bit.
[[nodiscard]] std::vector<std::byte> encode_relation(const slam::FoundRelation& found);
[[nodiscard]] types::Result<slam::FoundRelation> decode_relation(const slam::KeyframeId& id,
                                                                 std::span<const std::byte> bytes);

/// Of an entry without its id.
[[nodiscard]] std::vector<std::byte> encode_log(const LogBody& body);
[[nodiscard]] types::Result<LogBody> decode_log(std::span<const std::byte> bytes);

/// Of a status without robot, visited and looked. As many bids and then points of the way, in their order, as
/// `room` bytes hold. Their places are rounded to centimetres.
[[nodiscard]] std::vector<std::byte> encode_status(const StatusMessage& status, std::size_t room);
[[nodiscard]] types::Result<StatusMessage> decode_status(std::uint16_t robot,
                                                         std::span<const std::byte> bytes);

/// Whether bytes from outside are what their key says: they decode, and a keyframe has that id.
[[nodiscard]] types::Status check_item(const ItemKey& key, std::span<const std::byte> bytes);

}  // namespace topo::team
