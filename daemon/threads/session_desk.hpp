// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/pipeline/mapping_step.hpp"
#include "core/slam/session.hpp"
#include "core/sync/ring.hpp"
#include "daemon/threads/wakeup.hpp"

namespace topo::daemon {

/// What somebody who keeps sessions has of the map already.
struct SessionAsk {
  std::uint64_t number = 0;  ///< of the question
  std::uint64_t map = 0;     ///< number of the map that the rest is about
  std::uint64_t revision = 0;
  std::size_t keyframes = 0;
  bool sighting = false;  ///< the newest scan is wanted too
};

/// What he lacks. Keyframes are handed over by their numbers, so that none is lost, however late he asks.
struct SessionNews {
  std::uint64_t number = 0;  ///< of the question
  std::uint64_t map = 0;     ///< 1 since the start, one more for every session that was taken over
  std::uint64_t revision = 0;
  bool changed = false;    ///< false: nothing new since the revision that was named, and all below is empty
  std::size_t first = 0;   ///< number of the first keyframe below; 0 when the map is another one
  slam::Session session;   ///< keyframes from `first` on; all poses, all edges
  slam::Cloud cloud;       ///< the scan placed last, where it was wanted
  types::Se2 T_odom_base;  ///< at its stamp
};

/// Something large on its way through a ring, taken out by the consumer while the slot is his.
template <class T>
struct Parcel {
  mutable std::unique_ptr<T> content;
};

/// Hand-over between one who keeps sessions and the mapping thread.
struct SessionDesk {
  sync::Ring<SessionAsk, 2> asks;
  sync::Ring<Parcel<SessionNews>, 2> news;
  Wakeup answered;
};

/// Who keeps sessions, on his thread: asks and waits. The mapping thread answers between two scans.
class SessionClient {
 public:
  SessionClient(SessionDesk& desk, Wakeup& mapping) : desk_(desk), mapping_(mapping) {}

  /// Null when the mapping thread does not answer in time. Blocks.
  std::unique_ptr<const SessionNews> ask(SessionAsk question, types::Duration patience);

 private:
  SessionDesk& desk_;
  Wakeup& mapping_;
  std::uint64_t number_ = 0;
};

/// The mapping thread's side of the desk: answers what was asked.
void serve_desk(SessionDesk& desk, const pipeline::MappingState& state, std::uint64_t map);

}  // namespace topo::daemon
