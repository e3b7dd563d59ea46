// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/team/exchange/exchange.hpp"
#include "daemon/threads/area_log.hpp"
#include "daemon/threads/hand_overs.hpp"
#include "daemon/threads/team_hand_over.hpp"
#include "daemon/threads/vitals.hpp"
#include "daemon/threads/worker.hpp"

namespace topo::daemon {

struct TeamSettings {
  std::string name;
  std::uint16_t robot = 0;
  bool in_common_frame = false;  ///< the map begins at a configured pose in the team's common frame
  std::string socket;            ///< where the link connects
  bool awaits_journal = false;   ///< a session may be gone on with: TeamHandOver::journalled will come
  team::ExchangeParams exchange;
};

/// The team's thread: it owns the exchange and the socket to the link. It alone waits for either; without a
/// link the robot is alone, and everything else goes on.
class TeamWorker final : public Worker {
 public:
  TeamWorker(HandOvers& hand_overs, const TeamSettings& settings, Vitals& vitals)
      : hand_overs_(hand_overs), settings_(settings), vitals_(vitals) {}

  /// The thread's body: until hand_overs.ending.stopping.
  void run() noexcept override;

 private:
  /// A mate as last heard.
  struct Mate {
    team::HeardStatus heard;
    std::optional<types::Se2> T_map_mates;  ///< its map frame in this robot's
  };
  /// What is known of this robot's own map.
  struct Own {
    OwnMapAsk asked;  ///< the newest question that was answered, with the counts that follow from it
    std::vector<team::Anchor> anchors;
    bool in_common_frame = false;
    bool goes_on = false;  ///< a session of before is there
    bool waits = false;    ///< a question is under way
    types::Stamp next_ask{};
  };

  /// A status as mates get it: with the robot's number and where its map lies.
  [[nodiscard]] team::StatusMessage said(team::StatusMessage status) const;
  void take_journalled(types::Stamp now);
  void listen();
  void turn(types::Stamp now);
  void take_own(types::Stamp now);
  [[nodiscard]] bool is_held_back(const OwnMapNews& news) const;
  void begin_map(const OwnMapNews& news);
  void ask_mapping(types::Stamp now);
  void take_requests(types::Stamp now);
  void take_news(types::Stamp now);
  void note_status(team::HeardStatus heard);
  void relate_starts(const std::vector<slam::KeyframePtr>& keyframes, MatesMapNews& news);
  void hand_over_mates();
  void report(types::Stamp now);
  void warn(types::Stamp now, const std::string& words);

  HandOvers& hand_overs_;
  TeamSettings settings_;
  Vitals& vitals_;
  std::optional<LinkSocket> link_;
  std::optional<team::Exchange> exchange_;  ///< nothing before the first answer of mapping
  Own own_;
  std::map<std::uint16_t, Mate> mates_;
  std::set<slam::Origin> met_;      ///< mates whose start was related to this robot's in this map
  std::set<slam::Origin> started_;  ///< mates whose first keyframe has come
  /// Of an exchange before this map's, for mapping.
  std::vector<slam::KeyframePtr> late_keyframes_;
  std::vector<slam::FoundRelation> late_relations_;
  std::optional<team::EntryId> order_;
  AreaLog areas_;
  bool awaits_journal_ = settings_.awaits_journal;
  std::optional<types::Stamp> journal_limit_;
  types::Stamp duplicates_until_{};
  TeamReport report_;
  types::Stamp next_report_{};
};

}  // namespace topo::daemon
