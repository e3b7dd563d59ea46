// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/slam/keyframe.hpp"
#include "core/types/stamp.hpp"

// Round trip and loss between this robot and a mate. For display: no decision uses them.
namespace topo::team {

/// What presence says about one mate.
struct Echo {
  slam::Origin mate;
  std::uint64_t stamp_ms = 0;  ///< of its newest presence, by its clock
  std::uint64_t held_ms = 0;   ///< from that one's arrival to this message
  std::uint8_t lost_255 = 0;   ///< share of its datagrams that did not come, in 255ths
};

/// "Here I am", by which mates see round trip, loss, and who hears whom.
struct Presence {
  std::uint64_t stamp_ms = 0;  ///< of the sender's clock
  std::vector<Echo> echoes;    ///< of whom it hears
};

[[nodiscard]] std::vector<std::byte> encode_presence(const Presence& presence);
/// Nothing for malformed bytes.
[[nodiscard]] std::optional<Presence> decode_presence(std::span<const std::byte> bytes);

[[nodiscard]] std::uint64_t in_ms(types::Stamp stamp);

/// Of one mate. Value semantics.
class LinkEstimate {
 public:
  /// A datagram came.
  void note_datagram(std::uint32_t counter);
  /// Its presence came; `echo`: what it says of this robot.
  void note_presence(std::uint64_t stamp_ms, const std::optional<Echo>& echo, types::Stamp now);
  /// What this robot's presence says of it.
  [[nodiscard]] Echo echo(const slam::Origin& mate, types::Stamp now) const;

  [[nodiscard]] std::optional<double> round_trip_s() const { return round_trip_s_; }
  [[nodiscard]] std::optional<double> loss_in() const { return loss_in_; }
  [[nodiscard]] std::optional<double> loss_out() const { return loss_out_; }
  [[nodiscard]] std::optional<double> clock_offset_s() const { return clock_offset_s_; }

 private:
  std::uint32_t first_ = 0;  ///< counter at which the present count began
  std::uint32_t came_ = 0;   ///< datagrams since
  std::uint64_t presence_ms_ = 0;
  types::Stamp presence_at_{};
  bool has_presence_ = false;
  std::optional<double> round_trip_s_, loss_in_, loss_out_, clock_offset_s_;
};

}  // namespace topo::team
