// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <span>

#include "core/team/exchange/codecs.hpp"
#include "core/team/exchange/fields.hpp"

namespace topo::team {
namespace {

using types::ByteReader;
using types::ByteWriter;

// varint sequence, f64 pose (3) and start (2), u8 flags, home (2 f64) and claim (3 f64) by their flags;
// u8 number of anchors, each: varint run and sequence, f64 pose (3);
// varint number of bids, each: steps of x and y from the bid before in cm, cost in cm and whether essential;
// varint number of points of the way, each as steps in cm.
constexpr unsigned kHome = 1, kClaim = 2, kEssential = 4, kCommonFrame = 8, kDutyShift = 4, kFlags = 0x3F;
constexpr std::uint8_t kDuties = 3;
constexpr double kCm_m = kBidStep_m;

std::int64_t in_cm(double value_m) {
  if (!std::isfinite(value_m)) return 0;
  return std::llround(std::clamp(value_m, -kPlaceReach_m, kPlaceReach_m) / kCm_m);
}

/// Places as steps from one to the next.
class Steps {
 public:
  void write(ByteWriter& out, const types::Vector2& p) {
    for (const int axis : {0, 1}) {
      const std::int64_t now = in_cm(p[axis]);
      out.zigzag(now - last_[axis]);
      last_[axis] = now;
    }
  }
  types::Vector2 read(ByteReader& in, bool& ok) {
    types::Vector2 p;
    for (const int axis : {0, 1}) {
      const std::int64_t step = in.zigzag();
      ok = ok && std::abs(static_cast<double>(step)) <= 4.0 * kPlaceReach_m / kCm_m;
      last_[axis] = ok ? last_[axis] + step : 0;
      p[axis] = static_cast<double>(last_[axis]) * kCm_m;
    }
    ok = ok && in.ok() && is_in_reach(p);
    return p;
  }

 private:
  std::int64_t last_[2] = {0, 0};
};

/// Writes as many of `things` as there is room for, after their number.
template <class Things, class Write>
void write_list(ByteWriter& out, const Things& things, std::size_t room, Write write) {
  ByteWriter list;
  std::size_t count = 0;
  Steps steps;
  for (const auto& thing : things) {
    ByteWriter one;
    Steps after = steps;
    write(one, after, thing);
    if (list.bytes().size() + one.bytes().size() > room) break;
    list.append(one.bytes());
    steps = after;
    ++count;
  }
  out.varint(count);
  out.append(list.bytes());
}

void write_bid(ByteWriter& out, Steps& steps, const Bid& bid) {
  steps.write(out, bid.p_map);
  out.zigzag(in_cm(bid.cost_m) * 2 + (bid.essential ? 1 : 0));
}

Bid read_bid(ByteReader& in, Steps& steps, bool& ok) {
  Bid bid;
  bid.p_map = steps.read(in, ok);
  const std::int64_t cost = in.zigzag();
  bid.essential = (cost & 1) != 0;
  const std::int64_t cost_cm = (cost - (cost & 1)) / 2;
  bid.cost_m = static_cast<double>(cost_cm) * kCm_m;
  ok = ok && in.ok() && is_in_reach(bid.cost_m);
  return bid;
}

void write_pose(ByteWriter& out, const types::Se2& pose) {
  write_place(out, pose.translation());
  out.real(pose.theta_rad);
}

types::Se2 read_pose(ByteReader& in, bool& ok) {
  const types::Vector2 place = read_place(in, ok);
  const double theta_rad = in.real64();
  ok = ok && is_in_reach(theta_rad);
  return {place.x(), place.y(), theta_rad};
}

/// As many as there is room for, and for the two numbers that follow.
void write_anchors(ByteWriter& out, std::span<const Anchor> anchors, std::size_t room) {
  constexpr std::size_t kCounts_bytes = 1 + 4;
  ByteWriter list;
  std::uint8_t count = 0;
  for (const Anchor& anchor : anchors.first(std::min(anchors.size(), kAnchorsMax))) {
    ByteWriter one;
    one.varint(anchor.run);
    one.varint(anchor.sequence);
    write_pose(one, anchor.T_map_base);
    if (out.bytes().size() + list.bytes().size() + one.bytes().size() + kCounts_bytes > room) break;
    list.append(one.bytes());
    ++count;
  }
  out.integer(count);
  out.append(list.bytes());
}

void read_anchors(ByteReader& in, StatusMessage& status, bool& ok) {
  const auto count = in.integer<std::uint8_t>();
  ok = ok && in.ok() && count <= kAnchorsMax;
  for (std::uint8_t i = 0; ok && i < count; ++i) {
    Anchor& anchor = status.anchors.emplace_back();
    const std::uint64_t run = in.varint(), sequence = in.varint();
    ok = ok && run <= UINT32_MAX && sequence <= UINT32_MAX;
    anchor.run = static_cast<std::uint32_t>(run);
    anchor.sequence = static_cast<std::uint32_t>(sequence);
    anchor.T_map_base = read_pose(in, ok);
  }
}

void read_fixed(ByteReader& in, StatusMessage& status, bool& ok) {
  status.sequence = in.varint();
  status.T_map_base = read_pose(in, ok);
  status.start = read_place(in, ok);
  const auto flags = in.integer<std::uint8_t>();
  const unsigned duty = flags >> kDutyShift;
  ok = ok && (flags & ~kFlags) == 0 && duty < kDuties;
  status.duty = static_cast<Duty>(ok ? duty : 0);
  status.in_common_frame = (flags & kCommonFrame) != 0;
  if ((flags & kHome) != 0) status.home = read_place(in, ok);
  if ((flags & kClaim) == 0) return;
  Bid& claim = status.claim.emplace();
  claim.p_map = read_place(in, ok);
  claim.cost_m = in.real64();
  claim.essential = (flags & kEssential) != 0;
  ok = ok && in.ok() && is_in_reach(claim.cost_m);
}

}  // namespace

std::vector<std::byte> encode_status(const StatusMessage& status, std::size_t room) {
  ByteWriter out;
  out.varint(status.sequence);
  write_pose(out, status.T_map_base);
  write_place(out, status.start);
  out.integer(static_cast<std::uint8_t>((status.home ? kHome : 0U) | (status.claim ? kClaim : 0U) |
                                        (status.claim && status.claim->essential ? kEssential : 0U) |
                                        (status.in_common_frame ? kCommonFrame : 0U) |
                                        (static_cast<unsigned>(status.duty) << kDutyShift)));
  if (status.home) write_place(out, *status.home);
  if (status.claim) {
    write_place(out, status.claim->p_map);
    out.real(status.claim->cost_m);
  }
  write_anchors(out, status.anchors, room);
  // Two numbers of at most two bytes each follow. The way gets at least a fifth: others yield by it.
  const std::size_t left = room - std::min(room, out.bytes().size() + 4);
  write_list(out, status.bids, left - left / 5, write_bid);
  write_list(out, status.way_map, room - std::min(room, out.bytes().size() + 2),
             [](ByteWriter& one, Steps& steps, const types::Vector2& p) { steps.write(one, p); });
  return out.take();
}

types::Result<StatusMessage> decode_status(std::uint16_t robot, std::span<const std::byte> bytes) {
  ByteReader in(bytes);
  bool ok = true;
  types::Result<StatusMessage> result;
  StatusMessage& status = *result;
  status.robot = robot;
  read_fixed(in, status, ok);
  read_anchors(in, status, ok);
  const std::size_t bids = in.count(3);
  Steps bid_steps, way_steps;
  for (std::size_t i = 0; ok && i < bids; ++i) status.bids.push_back(read_bid(in, bid_steps, ok));
  const std::size_t points = in.count(2);
  for (std::size_t i = 0; ok && i < points; ++i) status.way_map.push_back(way_steps.read(in, ok));
  if (!ok || !in.complete())
    return types::fail(types::Errc::kProtocol,
                       "status: found a number out of reach, or other bytes than its fields");
  return result;
}

}  // namespace topo::team
