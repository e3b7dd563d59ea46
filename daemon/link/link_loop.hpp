// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "core/types/result.hpp"
#include "daemon/config/configuration.hpp"
#include "daemon/link/daemon_line.hpp"
#include "daemon/link/drop_log.hpp"
#include "daemon/link/network_watch.hpp"
#include "daemon/link/radio.hpp"
#include "drivers/io/unique_fd.hpp"

namespace topo::daemon {

struct LinkLoopParams {
  /// With the interface up a write returns within microseconds; 1.2 to 2.8 s were measured while it is down.
  /// Beyond this the radio hangs, and is made anew.
  types::Duration hang = std::chrono::seconds(10);
  /// After a participant that could not be made.
  types::Duration try_again = std::chrono::seconds(2);
  types::Duration stats_period = std::chrono::seconds(1);
  /// With credentials, without a mate for this long and up to `lonely_spread` more by chance, the radio is
  /// made anew. Under 30 % loss one handshake in five of Cyclone 0.10 was left half done for ever (a lost
  /// last message is not sent again); the others took 1 to 9 s.
  types::Duration lonely = std::chrono::seconds(15);
  types::Duration lonely_spread = std::chrono::seconds(10);
};

/// What a link that begins anew (execve) carries over.
struct Carried {
  int daemon_fd = -1;
  LinkStats stats;
  bool quiet = false;  ///< nothing of it is worth a line: a robot alone begins anew again and again
};
/// For the command line, and back. An unreadable text carries nothing.
[[nodiscard]] std::string carried_text(const Carried& carried);
[[nodiscard]] Carried parse_carried(const std::string& text);

/// The link's main loop: moves datagrams between the daemon's socket and the radio, and watches the
/// interface. Calls no function of DDS, so nothing of the radio can stop it.
class LinkLoop {
 public:
  enum class End {
    kStopped,  ///< by a signal
    kAnew,     ///< the participant must be made anew: begin the program anew, with carried()
  };

  static types::Result<std::unique_ptr<LinkLoop>> make(const TeamConfig& team, const Carried& carried,
                                                       const LinkLoopParams& params = {});

  /// Runs until the end. SIGTERM and SIGINT must be blocked.
  End run();
  /// Good until the object ends, and over execve(2).
  [[nodiscard]] Carried carried();

 private:
  LinkLoop(const TeamConfig& team, const Carried& carried, NetworkWatch network, io::UniqueFd signals,
           const LinkLoopParams& params);
  void wait();
  [[nodiscard]] bool stopped() const;
  bool must_begin_anew(types::Stamp now);
  bool lonely(types::Stamp now);
  void start_radio(types::Stamp now);
  void watch_radio();
  void exchange(types::Stamp now);
  void to_radio(std::span<const std::byte> datagram);
  void from_radio();
  void report(types::Stamp now);
  void tell_manager(const char* state);
  [[nodiscard]] LinkStats stats() const;
  void count(LinkDrop drop) { ++own_.dropped[static_cast<std::size_t>(drop)]; }

  TeamConfig team_;
  LinkLoopParams params_;
  LinkIdentity identity_;
  NetworkWatch network_;
  io::UniqueFd signals_;
  DaemonLine line_;
  std::unique_ptr<Radio> radio_;
  std::optional<NetworkAddress> made_for_;  // the radio
  std::optional<NetworkAddress> address_;   // now
  bool told_waiting_ = false, told_up_ = false;
  std::string told_failure_;
  types::Stamp failed_at_{}, next_stats_{};
  std::optional<types::Stamp> lonely_since_;
  bool quiet_ = false;       // the next radio comes up without a line
  bool came_quiet_ = false;  // and this one
  LinkStats own_;            // counted by this thread, and what was carried over
  DropLog drops_;
};

}  // namespace topo::daemon
