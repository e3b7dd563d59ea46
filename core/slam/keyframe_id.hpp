// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <compare>
#include <cstdint>
#include <tuple>

namespace topo::slam {

/// The source of keyframes: a robot in one run of its program. A robot that restarts its count has another
/// run number, so that no key occurs in two runs.
struct Origin {
  std::uint16_t robot = 0;
  std::uint32_t run = 0;
  friend auto operator<=>(const Origin&, const Origin&) = default;
};

/// The origin of a keyframe and its number there: the key of the grow-only set (DESIGN "Team"). Ordered by
/// robot, run and sequence.
struct KeyframeId {
  std::uint16_t robot = 0;
  std::uint32_t sequence = 0;
  std::uint32_t run = 0;
  [[nodiscard]] Origin origin() const { return {robot, run}; }
  friend bool operator==(const KeyframeId&, const KeyframeId&) = default;
  friend auto operator<=>(const KeyframeId& a, const KeyframeId& b) {
    return std::tie(a.robot, a.run, a.sequence) <=> std::tie(b.robot, b.run, b.sequence);
  }
};

}  // namespace topo::slam
