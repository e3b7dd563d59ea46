// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "daemon/control/json_rpc.hpp"

namespace topo::daemon {

/// A message as it goes to pages; shared by all that have not sent it yet.
using Text = std::shared_ptr<const std::string>;

/// What is said of the robot, in the order in which a page gets it when several are new.
/// The last two are of a replay.
enum class Topic {
  kLink,
  kStatus,
  kTeam,
  kGoals,
  kPlaces,
  kHealth,
  kDoctor,
  kTrails,
  kDoubt,
  kAreas,
  kScan,
  kReplay,
  kPast
};
inline constexpr std::size_t kTopics = 13;

/// The name of a topic in messages to pages.
std::string_view to_text(Topic topic);

/// The newest of everything that pages show. One of it for all pages; each page's Outbox says what that page
/// has of it. Each entry has a number that grows with every change. Holds one map, one text a topic and 64
/// events, however many pages there are. One thread.
class Board {
 public:
  static constexpr std::size_t kEvents = 64;

  /// One tile of the map, as the daemon told it (encode_cells in daemon/app/tile_book.hpp).
  struct Tile {
    std::uint64_t number = 0;
    std::string cells;
  };
  struct Entry {
    std::uint64_t number = 0;  ///< 0: nothing yet
    Text text{};
  };
  using Place = std::pair<std::int32_t, std::int32_t>;  ///< index of a tile

  /// {"t": TOPIC, "v": value}. What is as before is not sent again, but for state and link, by whose coming
  /// pages know that the robot is there.
  void post(Topic topic, const Json& value);
  void add_event(const Json& event);
  /// Takes an answer of map.tiles. False when it is none: nothing is taken.
  bool take_tiles(const Json& answer);
  /// The map is another one: pages drop what they have of it.
  void forget_map();

  [[nodiscard]] const Entry& at(Topic topic) const { return topics_[static_cast<std::size_t>(topic)]; }
  /// The oldest event after number `seen`; null when there is none.
  [[nodiscard]] const Entry* event_after(std::uint64_t seen) const;
  /// Counts the maps.
  [[nodiscard]] std::uint64_t map() const { return map_; }
  [[nodiscard]] std::uint64_t map_number() const { return number_of_map_; }

  /// A message with tiles that changed after number `seen`, oldest change first, until it has `most_bytes` of
  /// cells (at least one tile), and the number up to which the page then has them.
  struct Part {
    Json message;
    std::uint64_t number = 0;
  };
  [[nodiscard]] Part tiles_after(std::uint64_t seen, std::size_t most_bytes) const;

 private:
  std::array<Entry, kTopics> topics_;
  std::deque<Entry> events_;
  std::map<Place, Tile> tiles_;
  std::map<std::uint64_t, Place> by_number_;
  double resolution_m_ = 0.0;
  int side_ = 0;
  std::uint64_t numbers_ = 0, map_ = 1, number_of_map_ = 0;
};

}  // namespace topo::daemon
