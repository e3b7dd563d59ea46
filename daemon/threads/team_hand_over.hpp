// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/slam/keyframe.hpp"
#include "core/slam/relation_set.hpp"
#include "core/sync/latest.hpp"
#include "core/sync/ring.hpp"
#include "core/team/exchange/item.hpp"
#include "core/team/exchange/news.hpp"
#include "core/team/status_message.hpp"
#include "daemon/link/link_socket.hpp"
#include "daemon/threads/session_desk.hpp"
#include "daemon/threads/wakeup.hpp"

// Data between the team's thread and the others. No other thread ever waits for it.
namespace topo::daemon {

/// To mapping: what of this robot's map the team's thread has already.
struct OwnMapAsk {
  std::uint64_t map = 0;        ///< number of the map that the counts refer to; 0: none yet
  std::size_t keyframes = 0;    ///< of the robot's own way
  std::uint32_t relations = 0;  ///< number of the next one found in this map
  std::vector<slam::KeyframeId> poses_of;
};

/// From mapping.
struct OwnMapNews {
  std::uint64_t map = 0;  ///< 1 since the start, plus one for every session taken over
  slam::Origin origin;    ///< of the map's new keyframes
  /// Of the map, with those of earlier runs and of mates, when the question was about another one; else
  /// empty.
  std::vector<slam::KeyframePtr> held;
  std::vector<slam::FoundRelation> held_relations;  ///< the same, found by others or in earlier runs
  std::vector<slam::KeyframePtr> keyframes;         ///< of this run, since the question's count
  std::size_t own_way = 0;                          ///< the next question's count
  std::vector<slam::FoundRelation> relations;       ///< found since
  std::vector<team::Anchor> anchors;                ///< of this run, as of a status message
  std::vector<std::pair<slam::KeyframeId, types::Se2>> poses;  ///< of those asked for that the map holds
};

/// From the thread that reads sessions: what the one to go on with holds of all robots.
struct JournalledItems {
  std::vector<slam::KeyframePtr> keyframes;
  std::vector<slam::FoundRelation> relations;
};

/// To mapping: from mates, each once.
struct MatesMapNews {
  std::uint64_t map = 0;  ///< for which it was gathered; another map's is left out, and gathered again
  std::vector<slam::KeyframePtr> keyframes;
  std::vector<slam::FoundRelation> relations;
  std::vector<std::pair<slam::RelationKey, slam::Relation>> known;  ///< between starts in the common frame
};

/// To mapping: where mates are, in map, for cutting them out of scans.
struct MatesPlaces {
  struct Place {
    types::Vector2 p_map{0.0, 0.0};
    types::Stamp heard{};
  };
  std::vector<Place> places;
};

/// From main: an order of this robot's operator to the whole team or one mate, or that an order of a mate was
/// carried out or is refused.
struct TeamOrder {
  std::uint64_t number = 0;  ///< counted by main
  team::Order order;
};
struct OrderDone {
  team::EntryId order;
  std::string refused{};  ///< why; empty: it was carried out
};
/// From main, as a whole: the areas that this robot's operators drew for the team, and
/// those of any robot that they withdrew.
struct AreaWishes {
  struct Own {
    std::uint64_t number = 0;  ///< counted by main
    types::Polygon corners_map;
    types::AreaKind kind = types::AreaKind::kKeepOut;
  };
  std::vector<Own> own;
  std::vector<team::EntryId> withdrawn;
};

/// To main: what the team's log says of areas.
struct TeamAreas {
  struct OfMate {
    team::EntryId id;
    std::optional<types::Polygon> corners_map;  ///< nothing: it is not known where that robot's map lies
    types::AreaKind kind = types::AreaKind::kKeepOut;
  };
  std::vector<OfMate> of_mates;
  std::vector<team::EntryId> withdrawn;
  std::vector<std::uint64_t> own_withdrawn;  ///< numbers of own areas that a mate's operator withdrew
};

using TeamRequest = std::variant<TeamOrder, OrderDone>;

/// What is held of a stream: all items below `first_gap`.
struct HeldStream {
  team::StreamKey key;
  std::uint32_t first_gap = 0;
};

/// To main, for displays.
struct TeamReport {
  bool joined = false;  ///< a link is there
  std::string words;    ///< why not
  std::optional<LinkStats> link;
  LinkSocketCounts socket;
  team::ExchangeCounters counters;
  std::vector<team::PeerView> peers;
  std::vector<team::HeardStatus> statuses;  ///< in the mates' own frames
  std::vector<std::uint16_t> located;       ///< mates whose map frame is known here
  std::vector<team::StatusMessage> in_map;  ///< of these mates, in this robot's map
  std::vector<team::DuplicateId> duplicates;
  std::uint64_t order = 0;                       ///< number of the newest order of this robot's operator
  std::optional<std::uint16_t> order_to;         ///< the mate that it is for; nothing: all
  std::vector<std::uint16_t> acknowledged;       ///< by these robots
  std::map<std::uint16_t, std::string> refused;  ///< by these, with the reason
  std::size_t items = 0, bytes = 0;              ///< held
  std::vector<HeldStream> streams;               ///< at most CapParams::streams
  std::uint64_t hash = 0;                        ///< of all that is held
  TeamAreas areas;
};

struct TeamHandOver {
  Wakeup wakeup;  ///< of the team's thread
  sync::Ring<OwnMapAsk, 2> asks;
  sync::Ring<Parcel<OwnMapNews>, 2> own;
  /// Once; without items there is no session to go on with.
  sync::Ring<Parcel<JournalledItems>, 2> journalled;
  std::atomic<bool> begun_anew{false};  ///< from main: the map of this start stays, on the operator's word
  sync::Ring<Parcel<MatesMapNews>, 8> mates;
  sync::Latest<MatesPlaces> places;                         ///< to mapping
  sync::Latest<team::StatusMessage> status;                 ///< from planning
  sync::Latest<std::vector<team::StatusMessage>> statuses;  ///< to planning, in this robot's map
  sync::Ring<TeamRequest, 16> requests;                     ///< from main
  sync::Latest<AreaWishes> areas;                           ///< from main
  sync::Ring<team::HeardOrder, 16> orders;                  ///< to main
  Wakeup orders_here;                                       ///< of main
  sync::Latest<TeamReport> report;
};

}  // namespace topo::daemon
