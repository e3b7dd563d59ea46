// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <deque>
#include <string>
#include <utility>

#include "tests/sim/devices/sim_time.hpp"

namespace topo::sim {

/// Bytes on a line that holds them: a bridge or a radio with a long queue. All bytes arrive, in order and
/// late.
class DelayLine {
 public:
  static constexpr SimTime kMost = std::chrono::seconds{30};

  /// From now on bytes wait for `constant`, and for `growth` (s per s) times the time since now longer, at
  /// most kMost. Both 0: no delay; what still waits arrives at once.
  void set(SimTime constant, double growth, SimTime now) {
    constant_ = constant;
    growth_ = growth;
    since_ = now;
    if (active()) return;
    for (Piece& piece : pieces_) piece.due = now;
  }
  [[nodiscard]] bool active() const { return constant_ > SimTime{0} || growth_ > 0.0; }

  void push(std::string bytes, SimTime now) {
    const SimTime grown{static_cast<SimTime::rep>(growth_ * static_cast<double>((now - since_).count()))};
    const SimTime due = now + std::min(kMost, constant_ + grown);
    pieces_.push_back({std::move(bytes), pieces_.empty() ? due : std::max(due, pieces_.back().due)});
  }
  /// What has arrived by now; empty when nothing has.
  std::string take(SimTime now) {
    std::string bytes;
    for (; !pieces_.empty() && pieces_.front().due <= now; pieces_.pop_front())
      bytes += pieces_.front().bytes;
    return bytes;
  }
  void clear() { pieces_.clear(); }

 private:
  struct Piece {
    std::string bytes;
    SimTime due;
  };
  SimTime constant_{0}, since_{0};
  double growth_ = 0.0;
  std::deque<Piece> pieces_;
};

}  // namespace topo::sim
