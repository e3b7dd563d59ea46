// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>

#include "core/slam/keyframe.hpp"
#include "core/slam/pose_graph.hpp"
#include "core/types/se2.hpp"
#include "daemon/session/format.hpp"

namespace topo::daemon {

/// The items of a session by their numbers, as its records say; some may be missing. Maps, because the
/// numbers are a file's word: what is allocated depends on the bytes that are there.
class SessionItems {
 public:
  /// Applies the next record. False, with nothing changed, when the content is invalid for its kind.
  [[nodiscard]] bool take(const SessionRecordHead& head, std::span<const std::byte> content);
  /// A record is lost whose head is known, and later ones are not: what it replaced is void.
  void lose(const SessionRecordHead& head);

  std::map<std::uint64_t, slam::KeyframePtr> keyframes;
  std::map<std::uint64_t, slam::Edge> edges;
  std::map<std::uint64_t, types::Se2> poses;
  std::uint64_t poses_once = 0;  ///< most poses that were known at one time, gaps included
  bool poses_void = false;       ///< known ones became void by a loss
  std::uint64_t announced = 0;   ///< keyframes, by the record that closes the file
  bool closed = false;           ///< that record came

 private:
  bool take_keyframes(const SessionRecordHead& head, std::span<const std::byte> content);
  bool take_end(std::span<const std::byte> content);
};

/// Number behind the last item; 0 when there is none.
template <class Item>
[[nodiscard]] std::uint64_t number_behind(const std::map<std::uint64_t, Item>& items) {
  return items.empty() ? 0 : items.rbegin()->first + 1;
}

}  // namespace topo::daemon
