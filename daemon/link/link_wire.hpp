// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/types/result.hpp"

// The messages between the daemon and its link, each one packet of a Unix packet socket. No I/O.
namespace topo::daemon {

/// Longest datagram that the team exchanges: with the headers of RTPS and its encryption it is below an
/// Ethernet frame, so that losing one frame loses one datagram.
inline constexpr std::size_t kDatagramMax_bytes = 1200;
/// Of the messages below. Both programs come from one package; they differ while one of them is not restarted
/// yet.
inline constexpr std::uint16_t kLinkVersion = 3;

/// Who speaks: the same at both ends of the socket.
struct LinkIdentity {
  std::uint64_t team = 0;   ///< team_hash() of the team's name
  std::uint16_t robot = 0;  ///< number of the robot
  std::uint16_t version = kLinkVersion;
  friend bool operator==(const LinkIdentity&, const LinkIdentity&) = default;
};

/// Of a team's name: FNV-1a, 64 bits.
[[nodiscard]] std::uint64_t team_hash(std::string_view name);

/// First byte of every message.
enum class LinkMessage : std::uint8_t {
  kHello = 1,     ///< first in each direction
  kDatagram = 2,  ///< one datagram of the team, at most kDatagramMax_bytes
  kStats = 3,     ///< from the link, once a second: it lives
  kRefusal = 4,   ///< words why the sender closes the connection
  kHeard = 5,     ///< from the link: u16 number of the robot that sent it, and its datagram
};

/// Why a datagram that came to the link got no further.
enum class LinkDrop : std::uint8_t {
  kNoRadio,       ///< from the daemon, while the interface is absent or the participant is being made
  kRadioFull,     ///< from the daemon, while the radio takes nothing
  kWriteFailed,   ///< from the daemon, refused by DDS
  kWrongSize,     ///< from the daemon: empty or longer than kDatagramMax_bytes
  kNoDaemon,      ///< from the radio, while no daemon is connected
  kDaemonFull,    ///< from the radio, while the daemon's socket or the way to it is full
  kMalformed,     ///< from the radio: no robot's number, empty
  kOtherVersion,  ///< from the radio
  kOtherTeam,     ///< from the radio
  kOwnNumber,     ///< from the radio: another robot has this robot's number
  kRepeated,      ///< from the radio: received before, or older than all that can still be told apart
  kNotTrusted,    ///< refusals, not datagrams: a robot in reach has no credentials that this one accepts
  kFalseNumber,   ///< from the radio: under a number that is not that of the sender's partition
};
inline constexpr std::size_t kLinkDrops = 13;

/// In the words of the log: "no radio".
[[nodiscard]] std::string_view drop_name(LinkDrop drop);

/// What the link tells of itself. All counts are since its start.
struct LinkStats {
  bool radio = false;          ///< the participant exists; false: the interface is awaited
  std::uint16_t mates = 0;     ///< links of the team that are matched; one that is gone counts for 10 s more
  std::uint64_t sent = 0;      ///< datagrams handed to the radio
  std::uint64_t received = 0;  ///< datagrams handed to the daemon
  std::uint64_t sent_bytes = 0;
  std::uint64_t received_bytes = 0;
  std::array<std::uint64_t, kLinkDrops> dropped{};  ///< by LinkDrop
  [[nodiscard]] std::uint64_t dropped_by(LinkDrop drop) const {
    return dropped[static_cast<std::size_t>(drop)];
  }
  friend bool operator==(const LinkStats&, const LinkStats&) = default;
};

[[nodiscard]] std::vector<std::byte> encode_hello(const LinkIdentity& identity);
[[nodiscard]] std::vector<std::byte> encode_stats(const LinkStats& stats);
/// Text longer than the packet buffer of the other side is cut.
[[nodiscard]] std::vector<std::byte> encode_refusal(std::string_view words);

/// Of a packet that begins with kHello. kProtocol: it is no greeting of this project. A greeting of another
/// version is read as far as all versions have it in common: `version` alone.
[[nodiscard]] types::Result<LinkIdentity> decode_hello(std::span<const std::byte> packet);
/// kProtocol: it is none, or of another length.
[[nodiscard]] types::Result<LinkStats> decode_stats(std::span<const std::byte> packet);
/// Printable characters only.
[[nodiscard]] std::string decode_refusal(std::span<const std::byte> packet);

/// Empty when both ends fit together; otherwise what was found and what would be right, for the user of
/// `own`'s side.
[[nodiscard]] std::string mismatch(const LinkIdentity& own, const LinkIdentity& other);

}  // namespace topo::daemon
