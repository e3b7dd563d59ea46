// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <deque>

#include "daemon/view/board.hpp"

namespace topo::daemon {

/// What one page may keep waiting. A page that reads slowly gets less, never later: of a topic the newest,
/// and answers before state before events before the map.
struct OutboxParams {
  std::size_t answers = 32;        ///< to acts; a page that does not read that many is no operator's
  std::size_t map_bytes = 16'000;  ///< cells in one message: state waits for one such at most
};

/// What a page has of the board, and what it gets next. Holds answers alone; everything else is on the board.
/// Pure.
class Outbox {
 public:
  explicit Outbox(const OutboxParams& params = {}) : params_(params) {}

  /// False when too many wait: the page is to be dropped.
  [[nodiscard]] bool answer(const Json& message);
  /// From now on the page gets what is on the board.
  void show() { shown_ = true; }
  [[nodiscard]] bool shown() const { return shown_; }

  /// The next message; null when the page has everything.
  [[nodiscard]] Text next(const Board& board);

 private:
  [[nodiscard]] Text next_map(const Board& board);

  OutboxParams params_;
  std::deque<Text> answers_;
  bool shown_ = false;
  std::array<std::uint64_t, kTopics> seen_{};
  std::uint64_t events_seen_ = 0;
  std::uint64_t map_ = 0, map_seen_ = 0;
};

}  // namespace topo::daemon
