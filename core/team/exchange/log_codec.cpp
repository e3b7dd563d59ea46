// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <span>
#include <string>

#include "core/team/exchange/codecs.hpp"
#include "core/team/exchange/fields.hpp"
#include "core/team/exchange/wire.hpp"

namespace topo::team {
namespace {

using types::ByteReader;
using types::ByteWriter;

// u8 kind of the entry, then: a place and u8 `again`; a number of corners and their places; an order's kind;
// a key; a key; a number of corners and their places; an order's kind and a robot; a key, a number of bytes
// and these; a key, a number of corners and their places.
enum EntryKind : std::uint8_t {
  kVisited,
  kLookedInto,
  kKeepOut,
  kOrder,
  kAcknowledgement,
  kWithdrawn,
  kHereFirst,
  kOrderToOne,
  kRefusal,
  kAreaMoved
};

void write(ByteWriter& out, const Visited& body) {
  out.integer(static_cast<std::uint8_t>(kVisited));
  write_place(out, body.p_map);
  out.integer(static_cast<std::uint8_t>(body.again));
}
void write(ByteWriter& out, const LookedInto& body) {
  out.integer(static_cast<std::uint8_t>(kLookedInto));
  write_place(out, body.p_map);
  out.integer(static_cast<std::uint8_t>(body.again));
}
void write_corners(ByteWriter& out, const types::Polygon& corners_map) {
  out.varint(corners_map.size());
  for (const types::Vector2& corner : corners_map) write_place(out, corner);
}
void write(ByteWriter& out, const KeepOut& body) {
  out.integer(static_cast<std::uint8_t>(kKeepOut));
  write_corners(out, body.corners_map);
}
void write(ByteWriter& out, const HereFirst& body) {
  out.integer(static_cast<std::uint8_t>(kHereFirst));
  write_corners(out, body.corners_map);
}
void write(ByteWriter& out, const Order& body) {
  out.integer(static_cast<std::uint8_t>(body.to ? kOrderToOne : kOrder));
  out.integer(static_cast<std::uint8_t>(body.kind));
  if (body.to) out.integer(*body.to);
}
void write_key(ByteWriter& out, const EntryId& id) {
  write_origin(out, id.origin());
  out.varint(id.sequence);
}
void write(ByteWriter& out, const Acknowledgement& body) {
  out.integer(static_cast<std::uint8_t>(body.refused.empty() ? kAcknowledgement : kRefusal));
  write_key(out, body.order);
  if (body.refused.empty()) return;
  out.varint(body.refused.size());
  out.append(std::as_bytes(std::span(body.refused)));
}
void write(ByteWriter& out, const Withdrawn& body) {
  out.integer(static_cast<std::uint8_t>(kWithdrawn));
  write_key(out, body.area);
}
void write(ByteWriter& out, const AreaMoved& body) {
  out.integer(static_cast<std::uint8_t>(kAreaMoved));
  write_key(out, body.area);
  write_corners(out, body.corners_map);
}

EntryId read_key(ByteReader& in, bool& ok) {
  const slam::Origin origin = read_origin(in, ok);
  const std::uint64_t number = in.varint();
  ok = ok && number < kNumbersMax;
  return {origin.robot, static_cast<std::uint32_t>(number), origin.run};
}

bool read_flag(ByteReader& in, bool& ok) {
  const auto flag = in.integer<std::uint8_t>();
  ok = ok && flag <= 1;
  return flag == 1;
}

types::Polygon read_corners(ByteReader& in, bool& ok) {
  types::Polygon corners_map;
  const std::size_t corners = in.count(16);
  ok = ok && corners >= 3 && corners <= kCornersMax;
  for (std::size_t i = 0; ok && i < corners; ++i) corners_map.push_back(read_place(in, ok));
  return corners_map;
}

Order read_order(ByteReader& in, bool& ok) {
  const auto kind = in.integer<std::uint8_t>();
  ok = ok && kind < kOrderKinds;
  return {static_cast<OrderKind>(ok ? kind : 0)};
}

Order read_order_to_one(ByteReader& in, bool& ok) {
  Order order = read_order(in, ok);
  order.to = in.integer<std::uint16_t>();
  return order;
}

/// Printable ASCII: it is shown to an operator.
std::string read_refusal(ByteReader& in, bool& ok) {
  const std::size_t length = in.count(1);
  ok = ok && length >= 1 && length <= kRefusalBytesMax;
  std::string text;
  for (std::size_t i = 0; ok && i < length; ++i) text += static_cast<char>(in.integer<std::uint8_t>());
  ok = ok && std::ranges::all_of(text, [](char c) { return c >= ' ' && c <= '~'; });
  return text;
}

LogBody read(ByteReader& in, bool& ok) {
  switch (in.integer<std::uint8_t>()) {
    case kVisited: {
      const types::Vector2 p_map = read_place(in, ok);
      return Visited{p_map, read_flag(in, ok)};
    }
    case kLookedInto: {
      const types::Vector2 p_map = read_place(in, ok);
      return LookedInto{p_map, read_flag(in, ok)};
    }
    case kKeepOut:
      return KeepOut{read_corners(in, ok)};
    case kHereFirst:
      return HereFirst{read_corners(in, ok)};
    case kOrder:
      return read_order(in, ok);
    case kOrderToOne:
      return read_order_to_one(in, ok);
    case kAcknowledgement:
      return Acknowledgement{read_key(in, ok)};
    case kRefusal: {
      const EntryId order = read_key(in, ok);
      return Acknowledgement{order, read_refusal(in, ok)};
    }
    case kWithdrawn:
      return Withdrawn{read_key(in, ok)};
    case kAreaMoved: {
      const EntryId area = read_key(in, ok);
      return AreaMoved{area, read_corners(in, ok)};
    }
    default:
      ok = false;
      return Visited{};
  }
}

}  // namespace

std::string_view to_text(OrderKind kind) {
  switch (kind) {
    case OrderKind::kStop:
      return "stop";
    case OrderKind::kEstop:
      return "estop";
    case OrderKind::kStart:
      return "start";
    case OrderKind::kPause:
      return "pause";
    case OrderKind::kResume:
      return "resume";
    case OrderKind::kHome:
      return "home";
  }
  return "unknown";
}

std::vector<std::byte> encode_log(const LogBody& body) {
  ByteWriter out;
  std::visit([&](const auto& entry) { write(out, entry); }, body);
  return out.take();
}

types::Result<LogBody> decode_log(std::span<const std::byte> bytes) {
  ByteReader in(bytes);
  bool ok = true;
  LogBody body = read(in, ok);
  if (!ok || !in.complete())
    return types::fail(types::Errc::kProtocol,
                       "log entry: found another kind, a place out of reach or other bytes than its fields");
  return body;
}

}  // namespace topo::team
