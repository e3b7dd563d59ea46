// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/team/exchange/codecs.hpp"
#include "core/team/exchange/fields.hpp"
#include "core/team/exchange/wire.hpp"

namespace topo::team {
namespace {

using types::ByteReader;
using types::ByteWriter;

// u8 kind of the entry, then: a place and u8 `again`; a number of corners and their places; an order's kind;
// a key.
enum EntryKind : std::uint8_t { kVisited, kLookedInto, kKeepOut, kOrder, kAcknowledgement };
constexpr std::uint8_t kOrderKinds = 2;

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
void write(ByteWriter& out, const KeepOut& body) {
  out.integer(static_cast<std::uint8_t>(kKeepOut));
  out.varint(body.corners_map.size());
  for (const types::Vector2& corner : body.corners_map) write_place(out, corner);
}
void write(ByteWriter& out, const Order& body) {
  out.integer(static_cast<std::uint8_t>(kOrder));
  out.integer(static_cast<std::uint8_t>(body.kind));
}
void write(ByteWriter& out, const Acknowledgement& body) {
  out.integer(static_cast<std::uint8_t>(kAcknowledgement));
  write_origin(out, body.order.origin());
  out.varint(body.order.sequence);
}

bool read_flag(ByteReader& in, bool& ok) {
  const auto flag = in.integer<std::uint8_t>();
  ok = ok && flag <= 1;
  return flag == 1;
}

KeepOut read_keep_out(ByteReader& in, bool& ok) {
  KeepOut area;
  const std::size_t corners = in.count(16);
  ok = ok && corners >= 3 && corners <= kCornersMax;
  for (std::size_t i = 0; ok && i < corners; ++i) area.corners_map.push_back(read_place(in, ok));
  return area;
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
      return read_keep_out(in, ok);
    case kOrder: {
      const auto kind = in.integer<std::uint8_t>();
      ok = ok && kind < kOrderKinds;
      return Order{static_cast<OrderKind>(ok ? kind : 0)};
    }
    case kAcknowledgement: {
      const slam::Origin origin = read_origin(in, ok);
      const std::uint64_t number = in.varint();
      ok = ok && number < kNumbersMax;
      return Acknowledgement{{origin.robot, static_cast<std::uint32_t>(number), origin.run}};
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
