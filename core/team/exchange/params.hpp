// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace topo::team {

/// A datagram is at most so long: with the headers of UDP and of the carrier it stays below the 1,500 bytes
/// of an Ethernet or Wi-Fi frame, so that a lost frame loses one datagram.
inline constexpr std::size_t kDatagramBytesMax = 1'200;

/// Who speaks.
struct ExchangeIdentity {
  std::uint32_t team = 0;   ///< team_hash() of the team's name; datagrams of another team are dropped
  std::uint16_t robot = 0;  ///< different for each robot of the team
  /// Of this start of the program, which no other one has: the run of the keyframes and log entries made in
  /// it. Runs have no order: of two the one that was heard last is the newer.
  std::uint32_t run = 0;
};

/// The 32 bits that stand for a team's name in every datagram. They keep teams apart; they are no secret.
[[nodiscard]] std::uint32_t team_hash(std::string_view name);

/// Bytes per second and robot. Defaults are for an 802.11 radio that several teams share.
struct RateParams {
  double steady_bytes_per_s = 10'000.0;  ///< while little is wanted: 1.6 keyframes/s are 7 kB/s
  double catch_up_bytes_per_s =
      200'000.0;  ///< while mates lack much: from `catch_up_over_bytes` wanted until ...
  std::size_t catch_up_over_bytes = 12'000;  ///< three keyframes: what a lossy link leaves behind
  std::size_t caught_up_bytes = 6'000;       ///< ... less than this is: a keyframe
  /// What is not sent is saved up for so long: two periods of the caller. Contact after hours is no burst.
  double burst_s = 0.1;
  /// True when the carrier sends each datagram once to each mate (no multicast): each copy is charged.
  bool unicast = false;
};

/// When something is sent. Each period varies by `jitter`, so that robots do not fall into step.
struct PeriodParams {
  double jitter = 0.25;         ///< share of a period
  std::uint64_t seed = 1;       ///< of the jitter; different for each robot
  double status_s = 0.4;        ///< at most so often: the planning period
  double presence_s = 0.5;      ///< by which round trip and loss are estimated
  double summary_s = 1.0;       ///< at most so often, when something is new
  double idle_summary_s = 3.0;  ///< at least so often
  double want_s = 0.25;         ///< wants are repeated until they are met
  double order_s = 0.05;  ///< an order is repeated so often until all that are alive acknowledged it ...
  double order_repeat_s = 60.0;  ///< ... and at most for so long
  double alive_s = 3.0;          ///< a mate not heard for so long is out of reach: nothing is wanted from it
  double forget_s = 600.0;       ///< a mate not heard for so long is no longer listed; its items stay
  double overlap_s =
      1.0;  ///< two runs of one robot that are both heard over so long are two robots with one id
};

/// Bounds of what is wanted at once, and of what mates can cause here.
struct CapParams {
  std::size_t oldest_wanted = 96;          ///< incomplete keyframes, oldest first: 2 s of catching up
  std::size_t newest_wanted = 32;          ///< and newest first
  std::size_t small_wanted = 192;          ///< relations, and as many log entries
  std::size_t pushed = 8;                  ///< own new items of a kind that go before anybody asks, newest
  std::size_t wanted_items = 512;          ///< that one mate's wants may name; the rest is not looked at
  std::size_t peers = 32;                  ///< robots that are kept account of
  std::size_t streams = 512;               ///< 32 robots with five runs each
  std::size_t assembly_bytes = 8U << 20U;  ///< incomplete keyframes; the one longest untouched goes first
  std::size_t store_bytes = std::size_t{1} << 30U;  ///< complete items; further ones of mates are dropped
  std::size_t news_keyframes = 8;   ///< that take_news() gives at most: the mapper's share of a step
  std::size_t news_relations = 64;  ///< the same
};

struct ExchangeParams {
  RateParams rates;
  PeriodParams periods;
  CapParams caps;
};

}  // namespace topo::team
