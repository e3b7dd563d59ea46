// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/link/link_wire.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/types/bytes.hpp"

namespace topo::daemon {
namespace {

using types::Errc;
using types::fail;

constexpr std::uint32_t kMagic = 0x4C504F54;  // "TOPL", little-endian
constexpr std::size_t kWordsMax_bytes = 512;

types::ByteWriter begin(LinkMessage kind) {
  types::ByteWriter out;
  out.integer(static_cast<std::uint8_t>(kind));
  return out;
}

bool takes(types::ByteReader& in, LinkMessage kind) {
  return in.integer<std::uint8_t>() == static_cast<std::uint8_t>(kind) && in.ok();
}

}  // namespace

std::uint64_t team_hash(std::string_view name) {
  std::uint64_t hash = 0xCBF29CE484222325U;
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001B3U;
  return hash;
}

std::string_view drop_name(LinkDrop drop) {
  switch (drop) {
    case LinkDrop::kNoRadio:
      return "no radio";
    case LinkDrop::kRadioFull:
      return "radio full";
    case LinkDrop::kWriteFailed:
      return "write failed";
    case LinkDrop::kWrongSize:
      return "wrong size";
    case LinkDrop::kNoDaemon:
      return "no daemon";
    case LinkDrop::kDaemonFull:
      return "daemon full";
    case LinkDrop::kMalformed:
      return "malformed";
    case LinkDrop::kOtherVersion:
      return "another version";
    case LinkDrop::kOtherTeam:
      return "another team";
    case LinkDrop::kOwnNumber:
      return "own number used by another robot";
    case LinkDrop::kRepeated:
      return "repeated";
    case LinkDrop::kNotTrusted:
      return "not trusted";
    case LinkDrop::kFalseNumber:
      return "under a false number";
  }
  return "unknown";
}

std::vector<std::byte> encode_hello(const LinkIdentity& identity) {
  auto out = begin(LinkMessage::kHello);
  out.integer(kMagic);
  out.integer(identity.version);
  out.integer(identity.team);
  out.integer(identity.robot);
  return out.take();
}

std::vector<std::byte> encode_stats(const LinkStats& stats) {
  auto out = begin(LinkMessage::kStats);
  out.integer(static_cast<std::uint8_t>(stats.radio ? 1 : 0));
  out.integer(stats.mates);
  for (const auto count : {stats.sent, stats.received, stats.sent_bytes, stats.received_bytes})
    out.integer(count);
  for (const auto count : stats.dropped) out.integer(count);
  return out.take();
}

std::vector<std::byte> encode_refusal(std::string_view words) {
  auto out = begin(LinkMessage::kRefusal);
  out.append(std::as_bytes(std::span(words.substr(0, kWordsMax_bytes))));
  return out.take();
}

types::Result<LinkIdentity> decode_hello(std::span<const std::byte> packet) {
  types::ByteReader in(packet);
  const bool greets = takes(in, LinkMessage::kHello);
  const auto magic = in.integer<std::uint32_t>();
  LinkIdentity identity;
  identity.version = in.integer<std::uint16_t>();
  if (!greets || !in.ok() || magic != kMagic)
    return fail(Errc::kProtocol, "found no greeting, expected one of a daemon's link");
  if (identity.version != kLinkVersion) return identity;
  identity.team = in.integer<std::uint64_t>();
  identity.robot = in.integer<std::uint16_t>();
  if (!in.complete())
    return fail(Errc::kProtocol, fmt::format("found a greeting of {} bytes, expected 17", packet.size()));
  return identity;
}

types::Result<LinkStats> decode_stats(std::span<const std::byte> packet) {
  types::ByteReader in(packet);
  const bool stats_come = takes(in, LinkMessage::kStats);
  LinkStats stats;
  stats.radio = in.integer<std::uint8_t>() != 0;
  stats.mates = in.integer<std::uint16_t>();
  for (auto* count : {&stats.sent, &stats.received, &stats.sent_bytes, &stats.received_bytes})
    *count = in.integer<std::uint64_t>();
  for (auto& count : stats.dropped) count = in.integer<std::uint64_t>();
  if (!stats_come || !in.complete())
    return fail(Errc::kProtocol,
                fmt::format("found statistics of {} bytes, expected another length", packet.size()));
  return stats;
}

std::string decode_refusal(std::span<const std::byte> packet) {
  types::ByteReader in(packet);
  if (!takes(in, LinkMessage::kRefusal)) return {};
  return in.text();
}

std::string mismatch(const LinkIdentity& own, const LinkIdentity& other) {
  if (own.version != other.version)
    return fmt::format(
        "found version {} of the messages between topometricd and topolink, expected {}: restart both "
        "services, so that "
        "both are of the installed package",
        other.version, own.version);
  if (own.team != other.team)
    return "found another team's name at the other end, expected the same: both read [team] of one "
           "configuration; "
           "restart both services";
  if (own.robot != other.robot)
    return fmt::format(
        "found robot {} at the other end, expected {}: both read [team] of one configuration; restart both "
        "services",
        other.robot, own.robot);
  return {};
}

}  // namespace topo::daemon
