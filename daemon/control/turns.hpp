// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <deque>
#include <list>
#include <optional>
#include <string>

#include "core/types/stamp.hpp"
#include "daemon/control/user_quota.hpp"

namespace topo::daemon {

/// What a client may do, and whose it is.
struct Standing {
  bool may_command = false;
  uid_t user = static_cast<uid_t>(-1);
};

/// What clients who may not command may ask of the daemon. They only look (and e-stop, which has no quota).
/// A watching program asks once a second, a page that draws the robot ten times.
struct Quota {
  types::Duration request_period = std::chrono::milliseconds(50);  ///< of one user: 20 requests a second
  int request_burst = 20;  ///< of one user: a program that has just started asks for everything
  /// Of one user: 50 connections a second, of those that come with a question. topoctl makes one a call.
  types::Duration connection_period = std::chrono::milliseconds(20);
  int connection_burst = 50;  ///< of one user: a script that runs topoctl in a loop
  int unanswered = 2;  ///< of all of them: jobs (doctor, session.list) that share threads with commands
};

/// Requests that wait, and whose turn it is. One request of one client a turn: first an e-stop in whatever
/// place of whichever client's queue, then those who may command, in rotation, then the others, in rotation
/// and within their quota. After an e-stop one other request goes before the next e-stop, so that a flood of
/// them does not keep everything else out; an e-stop therefore waits for one other request at most. Pure.
class Turns {
 public:
  /// One request and its client.
  struct Turn {
    std::uint64_t client = 0;
    Standing standing;
    std::string line;
    /// An e-stop was served after this had arrived: what would undo it must not be done.
    bool overtaken = false;
  };

  explicit Turns(const Quota& quota)
      : requests_(quota.request_period, quota.request_burst), unanswered_max_(quota.unanswered) {}

  void join(std::uint64_t client, const Standing& standing);
  /// The client gets no answers any more. What it has asked for is still done where that has an effect: its
  /// e-stops, and its commands when it may command.
  void leave(std::uint64_t client);
  /// Precondition: the client has joined and not left.
  void add(std::uint64_t client, std::string line, bool estop);
  [[nodiscard]] std::size_t waiting(std::uint64_t client) const;

  /// Takes the request whose turn it is.
  std::optional<Turn> next(types::Stamp now);
  /// From when on next() gives a request; nothing while none waits, or none before an answer.
  [[nodiscard]] std::optional<types::Stamp> next_at(types::Stamp now) const;
  /// A request that next() gave was answered.
  void answered(bool may_command);

 private:
  struct Queued {
    std::string line;
    std::uint64_t stops_before = 0;  ///< e-stops that were served before this arrived
  };
  struct Client {
    std::uint64_t number = 0;
    Standing standing;
    bool left = false;
    std::deque<Queued> stops, others;
  };
  using Clients = std::list<Client>;

  [[nodiscard]] Clients::iterator find(std::uint64_t client);
  [[nodiscard]] Clients::iterator first_stop();
  [[nodiscard]] Clients::iterator first_other(types::Stamp now);
  Turn take(Clients::iterator client, std::deque<Queued>& queue);

  UserQuota requests_;  ///< of users who may not command
  int unanswered_max_;
  Clients clients_;  ///< whose turn was longest ago first
  std::uint64_t stops_served_ = 0;
  bool owes_other_ = false;  ///< the last turn was an e-stop
  int unanswered_ = 0;       ///< requests of those who may not command
};

}  // namespace topo::daemon
