// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/team/exchange/wire.hpp"

#include <algorithm>
#include <limits>

namespace topo::team {

using types::ByteReader;
using types::ByteWriter;

std::uint32_t team_hash(std::string_view name) {
  std::uint32_t hash = 2166136261U;  // FNV-1a (Fowler, Noll, Vo)
  for (const char c : name) hash = (hash ^ static_cast<std::uint8_t>(c)) * 16777619U;
  return hash;
}

HeadVerdict read_head(std::span<const std::byte> datagram, DatagramHead& head) {
  if (datagram.size() < 2 || datagram.size() > kDatagramBytesMax) return HeadVerdict::kMalformed;
  ByteReader in(datagram);
  if (in.integer<std::uint8_t>() != kWireMagic) return HeadVerdict::kMalformed;
  if (in.integer<std::uint8_t>() != kWireVersion) return HeadVerdict::kOtherVersion;
  DatagramHead read;
  read.team = in.integer<std::uint32_t>();
  read.sender.robot = in.integer<std::uint16_t>();
  read.sender.run = in.integer<std::uint32_t>();
  read.counter = in.integer<std::uint32_t>();
  if (!in.ok()) return HeadVerdict::kMalformed;
  head = read;
  return HeadVerdict::kGood;
}

MessageReader::MessageReader(std::span<const std::byte> datagram)
    : rest_(datagram.subspan(std::min(kHeadBytes, datagram.size()))) {}

std::optional<Message> MessageReader::next() {
  if (!ok_ || rest_.empty()) return std::nullopt;
  ByteReader in(rest_);
  Message message;
  message.kind = in.integer<std::uint8_t>();
  const std::size_t length = in.count(1);
  ok_ = in.ok();
  if (!ok_) return std::nullopt;
  message.body = rest_.subspan(rest_.size() - in.remaining(), length);
  rest_ = rest_.subspan(rest_.size() - in.remaining() + length);
  return message;
}

DatagramWriter::DatagramWriter(const DatagramHead& head) {
  ByteWriter out;
  out.integer(kWireMagic);
  out.integer(kWireVersion);
  out.integer(head.team);
  out.integer(head.sender.robot);
  out.integer(head.sender.run);
  out.integer(head.counter);
  bytes_ = out.take();
  bytes_.reserve(kDatagramBytesMax);
}

bool DatagramWriter::fits(std::size_t body_bytes) const {
  const std::size_t length_bytes = body_bytes < 0x80U ? 1 : 2;
  return bytes_.size() + 1 + length_bytes + body_bytes <= kDatagramBytesMax;
}

void DatagramWriter::add(MessageKind kind, std::span<const std::byte> body) {
  ByteWriter head;
  head.integer(static_cast<std::uint8_t>(kind));
  head.varint(body.size());
  bytes_.insert(bytes_.end(), head.bytes().begin(), head.bytes().end());
  bytes_.insert(bytes_.end(), body.begin(), body.end());
}

void write_origin(ByteWriter& out, const slam::Origin& origin) {
  out.varint(origin.robot);
  out.varint(origin.run);
}

slam::Origin read_origin(ByteReader& in, bool& ok) {
  const std::uint64_t robot = in.varint(), run = in.varint();
  ok = ok && in.ok() && robot <= std::numeric_limits<std::uint16_t>::max() &&
       run <= std::numeric_limits<std::uint32_t>::max();
  return {static_cast<std::uint16_t>(robot), static_cast<std::uint32_t>(run)};
}

void write_stream(ByteWriter& out, const StreamKey& key) {
  out.integer(static_cast<std::uint8_t>(key.kind));
  write_origin(out, key.origin);
}

StreamKey read_stream(ByteReader& in, bool& ok) {
  const auto kind = in.integer<std::uint8_t>();
  ok = ok && kind < kItemKinds;
  const slam::Origin origin = read_origin(in, ok);
  return {static_cast<ItemKind>(ok ? kind : 0), origin};
}

void write_key(ByteWriter& out, const ItemKey& key) {
  write_stream(out, key.stream);
  out.varint(key.number);
}

ItemKey read_key(ByteReader& in, bool& ok) {
  const StreamKey stream = read_stream(in, ok);
  const std::uint64_t number = in.varint();
  ok = ok && in.ok() && number < kNumbersMax;
  return {stream, static_cast<std::uint32_t>(number)};
}

std::string_view to_text(MessageKind kind) {
  switch (kind) {
    case MessageKind::kPresence:
      return "presence";
    case MessageKind::kStatus:
      return "status";
    case MessageKind::kSummary:
      return "summary";
    case MessageKind::kWants:
      return "wants";
    case MessageKind::kOrder:
      return "order";
    case MessageKind::kLog:
      return "log";
    case MessageKind::kRelation:
      return "relation";
    case MessageKind::kPiece:
      return "piece";
    case MessageKind::kCoded:
      return "coded";
  }
  return "unknown";
}

}  // namespace topo::team
