// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/session/session_items.hpp"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "core/slam/keyframe_codec.hpp"
#include "core/types/bytes.hpp"

namespace topo::daemon {
namespace {

constexpr std::size_t kPoseBytes = 24;
constexpr std::size_t kEdgeOldBytes = 2 + 1 + 9 * 8;           ///< minimum size
constexpr std::size_t kEdgeBytes = kEdgeOldBytes + 2 + 4 + 4;  ///< the same

types::Se2 read_pose(types::ByteReader& in) {
  types::Se2 pose;
  pose.x_m = in.real64();
  pose.y_m = in.real64();
  pose.theta_rad = in.real64();
  return pose;
}

slam::Edge read_edge_old(types::ByteReader& in) {
  slam::Edge edge;
  edge.from = static_cast<std::size_t>(in.varint());
  edge.to = static_cast<std::size_t>(in.varint());
  edge.robust = in.integer<std::uint8_t>() != 0;
  edge.T_from_to = read_pose(in);
  for (int row = 0; row < 3; ++row) {
    for (int column = row; column < 3; ++column)
      edge.information(row, column) = edge.information(column, row) = in.real64();
  }
  return edge;
}

slam::Edge read_edge(types::ByteReader& in) {
  slam::Edge edge = read_edge_old(in);
  edge.finder.robot = in.integer<std::uint16_t>();
  edge.finder.run = in.integer<std::uint32_t>();
  edge.finder.sequence = in.integer<std::uint32_t>();
  return edge;
}

/// Replaces all items from the first number on; false, with nothing changed, when bytes remain or, in
/// version 1, the number leaves a gap.
template <class Item, class Read>
bool replace_from(const SessionRecordHead& head, std::span<const std::byte> content,
                  std::map<std::uint64_t, Item>& items, std::size_t bytes_each, Read read) {
  types::ByteReader in(content);
  const std::uint64_t first = head.first ? *head.first : in.varint();
  if (!in.ok() || (!head.first && first > number_behind(items))) return false;
  std::vector<Item> read_items;
  while (in.ok() && in.remaining() >= bytes_each) read_items.push_back(read(in));
  if (!in.complete()) return false;
  items.erase(items.lower_bound(first), items.end());
  for (std::uint64_t number = first; Item & item : read_items)
    items.emplace_hint(items.end(), number++, item);
  return true;
}

}  // namespace

bool SessionItems::take_keyframes(const SessionRecordHead& head, std::span<const std::byte> content) {
  std::vector<slam::KeyframePtr> read;
  while (!content.empty()) {
    types::ByteReader in(content);
    const std::size_t size = in.count(1);
    if (!in.ok() || size > in.remaining()) return false;
    content = content.last(in.remaining());
    auto keyframe = slam::decode_keyframe(content.first(size));
    if (!keyframe) return false;
    read.push_back(std::make_shared<const slam::Keyframe>(std::move(*keyframe)));
    content = content.subspan(size);
  }
  std::uint64_t number = head.first ? *head.first : number_behind(keyframes);
  for (slam::KeyframePtr& keyframe : read) keyframes.insert_or_assign(number++, std::move(keyframe));
  return true;
}

bool SessionItems::take_end(std::span<const std::byte> content) {
  types::ByteReader in(content);
  const std::uint64_t all_keyframes = in.varint(), all_edges = in.varint(), all_poses = in.varint();
  // More items than announced: not the end of this file.
  if (!in.complete() || all_keyframes < number_behind(keyframes) || all_edges < number_behind(edges) ||
      all_poses < number_behind(poses))
    return false;
  announced = all_keyframes;
  closed = true;
  return true;
}

bool SessionItems::take(const SessionRecordHead& head, std::span<const std::byte> content) {
  bool taken = false;
  switch (head.kind) {
    case SessionRecord::kKeyframes:
      taken = take_keyframes(head, content);
      break;
    case SessionRecord::kEdgesOld:
      taken = replace_from(head, content, edges, kEdgeOldBytes, &read_edge_old);
      break;
    case SessionRecord::kEdges:
      taken = replace_from(head, content, edges, kEdgeBytes, &read_edge);
      break;
    case SessionRecord::kPoses:
      taken = replace_from(head, content, poses, kPoseBytes, &read_pose);
      poses_once = std::max(poses_once, number_behind(poses));
      break;
    case SessionRecord::kEnd:
      taken = take_end(content);
      break;
  }
  return taken;
}

void SessionItems::lose(const SessionRecordHead& head) {
  if (!head.first) return;
  const bool of_edges = head.kind == SessionRecord::kEdges || head.kind == SessionRecord::kEdgesOld;
  if (of_edges) edges.erase(edges.lower_bound(*head.first), edges.end());
  if (head.kind != SessionRecord::kPoses || *head.first >= number_behind(poses)) return;
  poses.erase(poses.lower_bound(*head.first), poses.end());
  poses_void = true;
}

}  // namespace topo::daemon
