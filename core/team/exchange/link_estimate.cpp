// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/team/exchange/link_estimate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/team/exchange/wire.hpp"

namespace topo::team {
namespace {

using types::ByteReader;
using types::ByteWriter;

constexpr std::uint32_t kLossSpan = 64;   // datagrams over which loss is counted
constexpr double kSmoothing = 0.25;       // weight of what is new
constexpr double kRoundTripMax_s = 60.0;  // a longer one is an echo of nonsense

void blend(std::optional<double>& estimate, double value) {
  estimate = estimate ? *estimate + kSmoothing * (value - *estimate) : value;
}

}  // namespace

std::uint64_t in_ms(types::Stamp stamp) {
  const auto ms = std::chrono::duration_cast<std::chrono::milliseconds>(stamp.time_since_epoch()).count();
  return static_cast<std::uint64_t>(std::max<std::int64_t>(ms, 0));
}

std::vector<std::byte> encode_presence(const Presence& presence) {
  ByteWriter out;
  out.varint(presence.stamp_ms);
  out.varint(presence.echoes.size());
  for (const Echo& echo : presence.echoes) {
    write_origin(out, echo.mate);
    out.varint(echo.stamp_ms);
    out.varint(echo.held_ms);
    out.integer(echo.lost_255);
  }
  return out.take();
}

std::optional<Presence> decode_presence(std::span<const std::byte> bytes) {
  ByteReader in(bytes);
  bool ok = true;
  Presence presence;
  presence.stamp_ms = in.varint();
  const std::size_t echoes = in.count(5);
  for (std::size_t i = 0; ok && in.ok() && i < echoes; ++i) {
    Echo& echo = presence.echoes.emplace_back();
    echo.mate = read_origin(in, ok);
    echo.stamp_ms = in.varint();
    echo.held_ms = in.varint();
    echo.lost_255 = in.integer<std::uint8_t>();
  }
  return ok && in.complete() ? std::optional(std::move(presence)) : std::nullopt;
}

void LinkEstimate::note_datagram(std::uint32_t counter) {
  if (came_ == 0) first_ = counter;
  ++came_;
  const std::uint32_t span = counter - first_ + 1;
  if (!is_later(counter, first_) || span < kLossSpan) return;
  blend(loss_in_, std::max(0.0, 1.0 - static_cast<double>(came_) / static_cast<double>(span)));
  came_ = 0;
}

void LinkEstimate::note_presence(std::uint64_t stamp_ms, const std::optional<Echo>& echo, types::Stamp now) {
  presence_ms_ = stamp_ms;
  presence_at_ = now;
  has_presence_ = true;
  if (!echo) return;
  loss_out_ = echo->lost_255 / 255.0;
  const double back_s = (static_cast<double>(in_ms(now)) - static_cast<double>(echo->stamp_ms) -
                         static_cast<double>(echo->held_ms)) /
                        1000.0;
  if (!(back_s >= 0.0 && back_s <= kRoundTripMax_s)) return;
  blend(round_trip_s_, back_s);
  clock_offset_s_ =
      (static_cast<double>(stamp_ms) - static_cast<double>(in_ms(now))) / 1000.0 + *round_trip_s_ / 2.0;
}

Echo LinkEstimate::echo(const slam::Origin& mate, types::Stamp now) const {
  Echo echo{mate, presence_ms_, 0, 0};
  if (has_presence_) echo.held_ms = in_ms(now) - std::min(in_ms(now), in_ms(presence_at_));
  echo.lost_255 =
      static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(loss_in_.value_or(0.0), 0.0, 1.0)));
  return echo;
}

}  // namespace topo::team
