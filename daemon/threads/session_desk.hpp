// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/slam/session.hpp"
#include "core/sync/ring.hpp"
#include "daemon/threads/wakeup.hpp"

namespace topo::pipeline {
class MappingState;
}

namespace topo::daemon {

/// Request of a client that keeps sessions: the part of the map that it already has.
struct SessionAsk {
  std::uint64_t number = 0;  ///< of the request
  std::uint64_t map = 0;     ///< number of the map that the other fields refer to
  std::uint64_t revision = 0;
  std::size_t keyframes = 0;
  bool sighting = false;  ///< true: the newest scan is requested too
};

/// Answer to a SessionAsk: the parts that the client lacks. Keyframes are passed by their numbers, so that
/// none is lost, however late the request.
struct SessionNews {
  std::uint64_t number = 0;  ///< of the request
  std::uint64_t map = 0;     ///< 1 since the start, plus one for every session taken over
  std::uint64_t revision = 0;
  bool changed = false;    ///< false: nothing new since the given revision; all below but the scan is empty
  std::size_t first = 0;   ///< number of the first keyframe below; 0 for another map
  slam::Session session;   ///< keyframes from `first` on; all poses and edges
  slam::Cloud cloud;       ///< the newest placed scan, when requested
  types::Se2 T_odom_base;  ///< at its stamp
};

/// A large object passed through a ring; the consumer moves it out while it holds the slot.
template <class T>
struct Parcel {
  mutable std::unique_ptr<T> content;
};

/// Hand-over between a client that keeps sessions and the mapping thread.
struct SessionDesk {
  sync::Ring<SessionAsk, 2> asks;
  sync::Ring<Parcel<SessionNews>, 2> news;
  Wakeup answered;
};

/// The client's side of the desk, on its own thread: sends a request and waits. The mapping thread answers
/// between two scans.
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

/// The mapping thread's side of the desk: answers all waiting requests.
void serve_desk(SessionDesk& desk, const pipeline::MappingState& state, std::uint64_t map);

}  // namespace topo::daemon
