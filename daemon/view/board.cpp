// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/view/board.hpp"

#include <algorithm>
#include <utility>

namespace topo::daemon {
namespace {

constexpr std::size_t kMostTiles = 65'536;  ///< 670,000 m2; what claims more is no map of a building
constexpr int kMostSide = 256;

Text text_of(const Json& message) {
  // A device may say anything: what is not UTF-8 is replaced.
  return std::make_shared<const std::string>(message.dump(-1, ' ', false, Json::error_handler_t::replace));
}

bool is_tile(const Json& tile) {
  return tile.is_array() && tile.size() == 3 && tile[0].is_number_integer() && tile[1].is_number_integer() &&
         tile[2].is_string();
}

}  // namespace

std::string_view to_text(Topic topic) {
  constexpr std::array<std::string_view, kTopics> kNames{"link",   "status", "team",   "goals", "places",
                                                         "health", "doctor", "trails", "doubt", "areas",
                                                         "scan",   "replay", "past"};
  return kNames[static_cast<std::size_t>(topic)];
}

void Board::post(Topic topic, const Json& value) {
  Entry& entry = topics_[static_cast<std::size_t>(topic)];
  Text text = text_of({{"t", to_text(topic)}, {"v", value}});
  const bool shows_life = topic == Topic::kStatus || topic == Topic::kLink;
  if (!shows_life && entry.text != nullptr && *entry.text == *text) return;
  entry = {++numbers_, std::move(text)};
}

void Board::add_event(const Json& event) {
  events_.push_back({++numbers_, text_of({{"t", "event"}, {"v", event}})});
  if (events_.size() > kEvents) events_.pop_front();
}

const Board::Entry* Board::event_after(std::uint64_t seen) const {
  const auto found = std::ranges::upper_bound(events_, seen, {}, &Entry::number);
  return found == events_.end() ? nullptr : &*found;
}

bool Board::take_tiles(const Json& answer) {
  const auto tiles = answer.find("tiles"), resolution = answer.find("resolution_m"),
             side = answer.find("side");
  if (tiles == answer.end() || resolution == answer.end() || side == answer.end()) return false;
  if (!tiles->is_array() || !resolution->is_number() || !side->is_number_integer()) return false;
  if (*side < 1 || *side > kMostSide || !std::ranges::all_of(*tiles, is_tile)) return false;
  resolution_m_ = resolution->get<double>();
  side_ = side->get<int>();
  for (const Json& told : *tiles) {
    const Place place{told[0].get<std::int32_t>(), told[1].get<std::int32_t>()};
    if (tiles_.size() >= kMostTiles && !tiles_.contains(place)) continue;
    Tile& tile = tiles_[place];
    by_number_.erase(tile.number);
    tile = {++numbers_, told[2].get<std::string>()};
    by_number_[tile.number] = place;
    number_of_map_ = tile.number;
  }
  return true;
}

void Board::forget_map() {
  ++map_;
  tiles_.clear();
  by_number_.clear();
  number_of_map_ = 0;
}

Board::Part Board::tiles_after(std::uint64_t seen, std::size_t most_bytes) const {
  Part part{{{"t", "map"}, {"map", map_}, {"side", side_}, {"resolution_m", resolution_m_}}, seen};
  Json& tiles = part.message["tiles"] = Json::array();
  std::size_t bytes = 0;
  for (auto next = by_number_.upper_bound(seen); next != by_number_.end() && bytes < most_bytes; ++next) {
    const std::string& cells = tiles_.at(next->second).cells;
    tiles.push_back(Json::array({next->second.first, next->second.second, cells}));
    bytes += cells.size();
    part.number = next->first;
  }
  return part;
}

}  // namespace topo::daemon
