// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/view/outbox.hpp"

#include <utility>

namespace topo::daemon {

bool Outbox::answer(const Json& message) {
  if (answers_.size() >= params_.answers) return false;
  answers_.push_back(
      std::make_shared<const std::string>(message.dump(-1, ' ', false, Json::error_handler_t::replace)));
  return true;
}

Text Outbox::next(const Board& board) {
  if (!answers_.empty()) {
    Text text = std::move(answers_.front());
    answers_.pop_front();
    return text;
  }
  if (!shown_) return nullptr;
  for (std::size_t i = 0; i < kTopics; ++i) {
    const Board::Entry& entry = board.at(static_cast<Topic>(i));
    if (entry.number <= seen_[i]) continue;
    seen_[i] = entry.number;
    return entry.text;
  }
  if (const Board::Entry* event = board.event_after(events_seen_)) {
    events_seen_ = event->number;
    return event->text;
  }
  return next_map(board);
}

/// A page learns of another map at once, also while that is empty.
Text Outbox::next_map(const Board& board) {
  const bool other = map_ != board.map();
  if (other) map_seen_ = 0;
  map_ = board.map();
  if (!other && map_seen_ >= board.map_number()) return nullptr;
  const Board::Part part = board.tiles_after(map_seen_, params_.map_bytes);
  map_seen_ = part.number;
  return std::make_shared<const std::string>(part.message.dump());
}

}  // namespace topo::daemon
