// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "core/types/result.hpp"
#include "core/types/stamp.hpp"
#include "daemon/link/link_channel.hpp"
#include "daemon/link/link_wire.hpp"
#include "drivers/io/unix_socket.hpp"

namespace topo::daemon {

struct LinkSocketParams {
  /// A link that says nothing this long is stopped or hangs: it tells its statistics once a second.
  types::Duration silence_max = std::chrono::seconds(3);
  /// Messages taken in one turn, so that a flood leaves the caller its turn. At 200 kB/s, the most that the
  /// exchange asks for, a turn every 100 ms finds 17.
  std::size_t messages_a_turn = 256;
};

/// Whether there is a way to the team, when that changes.
struct LinkNews {
  enum class Kind {
    kJoined,   ///< a link is connected and lives; whether a team-mate is in reach, LinkStats says
    kAlone,    ///< no link, or it says nothing
    kRefused,  ///< a link is there that does not fit; once for the same words
  };
  Kind kind;
  std::string words;  ///< for the log
};

/// Datagrams between the daemon and its link.
struct LinkSocketCounts {
  std::uint64_t sent = 0;
  std::uint64_t received = 0;
  std::uint64_t dropped_alone = 0;  ///< to be sent while no link was there
  std::uint64_t dropped_full = 0;   ///< to be sent while the link took nothing
  std::uint64_t dropped_size = 0;   ///< to be sent, empty or longer than kDatagramMax_bytes
  std::uint64_t malformed = 0;      ///< received, of no known kind or length
};

/// The daemon's end: listens, and serves one link at a time. No call ever waits; what finds no room is
/// dropped and counted. For one thread.
class LinkSocket {
 public:
  /// Only the user who runs the daemon, and root, can connect. Errors as of io::ListeningSocket::open().
  static types::Result<LinkSocket> listen(const std::string& path, const LinkIdentity& own,
                                          const LinkSocketParams& params = {});

  /// Takes the number of a robot and a datagram that it sent; what it is given is good during the call.
  using Take = std::function<void(std::uint16_t, std::span<const std::byte>)>;
  /// Accepts a link, takes what it sent. Returns what changed. To be called whenever fd() is readable, and
  /// once a second at least.
  [[nodiscard]] std::optional<LinkNews> turn(types::Stamp now, const Take& take);

  /// False: dropped, and counted.
  bool send(std::span<const std::byte> datagram);

  [[nodiscard]] bool joined() const { return joined_; }
  [[nodiscard]] const LinkSocketCounts& counts() const { return counts_; }
  /// What the link told of itself last; nothing while it is not there.
  [[nodiscard]] const std::optional<LinkStats>& link() const { return link_; }
  /// For a poll loop; readable when turn() has something to do.
  [[nodiscard]] int fd() const { return events_.get(); }

 private:
  LinkSocket(io::ListeningSocket listening, io::UniqueFd events, const LinkIdentity& own,
             const LinkSocketParams& params)
      : listening_(std::move(listening)), events_(std::move(events)), own_(own), params_(params) {}
  void accept(types::Stamp now);
  void take_messages(types::Stamp now, const Take& take);
  std::optional<LinkNews> changed(types::Stamp now);
  std::optional<LinkNews> alone(std::string words);

  io::ListeningSocket listening_;
  io::UniqueFd events_;  // epoll: the listening socket and the channel's
  LinkIdentity own_;
  LinkSocketParams params_;
  std::optional<LinkChannel> channel_;
  std::optional<types::Stamp> heard_;  // from the channel; before the first, the first turn
  bool joined_ = false;
  bool told_alone_ = false;
  std::string told_refusal_;
  LinkSocketCounts counts_;
  std::optional<LinkStats> link_;
};

}  // namespace topo::daemon
