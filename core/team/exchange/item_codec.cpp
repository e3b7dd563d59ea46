// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/slam/keyframe_codec.hpp"
#include "core/team/exchange/codecs.hpp"
#include "core/team/exchange/wire.hpp"

namespace topo::team {
namespace {

// Flags of a relation: most tie a robot's keyframes to one another, and need no origins.
constexpr unsigned kRobust = 1, kFromIsFinders = 2, kToIsFroms = 4;

bool valid_id(std::uint64_t sequence) { return sequence <= 0xFFFF'FFFFULL; }

}  // namespace

std::vector<std::byte> encode_relation(const slam::FoundRelation& found) {
  const auto& [from, to] = found.key;
  const slam::Relation& relation = found.relation;
  const bool own = from.origin() == found.id.origin(), same = to.origin() == from.origin();
  types::ByteWriter out;
  out.integer(static_cast<std::uint8_t>((relation.robust ? kRobust : 0U) | (own ? kFromIsFinders : 0U) |
                                        (same ? kToIsFroms : 0U)));
  if (!own) write_origin(out, from.origin());
  if (!same) write_origin(out, to.origin());
  out.varint(from.sequence);
  out.zigzag(static_cast<std::int64_t>(to.sequence) - static_cast<std::int64_t>(from.sequence));
  for (const double value : {relation.T_from_to.x_m, relation.T_from_to.y_m, relation.T_from_to.theta_rad})
    out.real(value);
  for (Eigen::Index row = 0; row < 3; ++row) {
    for (Eigen::Index column = row; column < 3; ++column) out.real(relation.information(row, column));
  }
  return out.take();
}

types::Result<slam::FoundRelation> decode_relation(const slam::KeyframeId& id,
                                                   std::span<const std::byte> bytes) {
  types::ByteReader in(bytes);
  bool ok = true;
  const auto flags = in.integer<std::uint8_t>();
  const slam::Origin from = (flags & kFromIsFinders) != 0 ? id.origin() : read_origin(in, ok);
  const slam::Origin to = (flags & kToIsFroms) != 0 ? from : read_origin(in, ok);
  const std::uint64_t sequence = in.varint();
  ok = ok && valid_id(sequence);
  const std::int64_t step = in.zigzag();
  ok = ok && std::abs(static_cast<double>(step)) <= 4294967296.0;
  const std::uint64_t to_sequence = ok ? sequence + static_cast<std::uint64_t>(step) : 0;
  ok = ok && valid_id(to_sequence);
  slam::FoundRelation found;
  found.id = id;
  found.key = {{from.robot, static_cast<std::uint32_t>(sequence), from.run},
               {to.robot, static_cast<std::uint32_t>(to_sequence), to.run}};
  found.relation.robust = (flags & kRobust) != 0;
  found.relation.T_from_to.x_m = in.real64();
  found.relation.T_from_to.y_m = in.real64();
  found.relation.T_from_to.theta_rad = in.real64();
  for (Eigen::Index row = 0; row < 3; ++row) {
    for (Eigen::Index column = row; column < 3; ++column)
      found.relation.information(row, column) = found.relation.information(column, row) = in.real64();
  }
  if (!ok || !in.complete() || flags > (kRobust | kFromIsFinders | kToIsFroms))
    return types::fail(types::Errc::kProtocol, "relation: found other bytes than its fields");
  if (const types::Status status = check_relation(found); !status) return tl::unexpected(status.error());
  return found;
}

types::Status check_item(const ItemKey& key, std::span<const std::byte> bytes) {
  const auto& [robot, run] = key.stream.origin;
  const slam::KeyframeId id{robot, key.number, run};
  const auto failed = [](const auto& result) -> types::Status { return tl::unexpected(result.error()); };
  if (key.stream.kind == ItemKind::kLog) {
    const auto entry = decode_log(bytes);
    return entry ? types::Status{} : failed(entry);
  }
  if (key.stream.kind == ItemKind::kRelation) {
    const auto relation = decode_relation(id, bytes);
    return relation ? types::Status{} : failed(relation);
  }
  const auto keyframe = slam::decode_keyframe(bytes);
  if (!keyframe) return failed(keyframe);
  if (keyframe->id != id)
    return types::fail(types::Errc::kProtocol, "keyframe: found another id than that of its key");
  return {};
}

}  // namespace topo::team
