// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/threads/mapping_team.hpp"

#include <memory>
#include <utility>

#include "core/slam/found_relations.hpp"
#include "core/team/masked_scan.hpp"
#include "core/team/roster.hpp"

namespace topo::daemon {
namespace {

/// A scanner sees 30 m (UTM-30LX); a mate farther away is in no scan.
constexpr double kSight_m = 31.0;
/// Keyframes behind the newest own one: mates mostly hold it already.
constexpr std::size_t kAnchorBehind = 10;

/// The first keyframe of the run and a late one. The way is searched from its end: it costs what is asked
/// for, and not the length of the way.
std::vector<team::Anchor> anchors_of(const slam::Mapper& mapper) {
  std::vector<team::Anchor> anchors;
  const auto add = [&](std::size_t node) {
    const slam::KeyframeId& id = mapper.keyframes()[node]->id;
    anchors.push_back({id.run, id.sequence, mapper.poses()[node]});
  };
  const slam::Origin& origin = mapper.origin();
  const auto first = mapper.node_of({origin.robot, 0, origin.run});
  if (!first) return anchors;
  add(*first);
  const auto way = mapper.own_way();
  std::size_t behind = 0;
  for (std::size_t i = way.size(); i-- > 0 && way[i] != *first; ++behind) {
    if (behind < kAnchorBehind && i > 0 && way[i - 1] != *first) continue;
    add(way[i]);
    break;
  }
  return anchors;
}

void add_poses(const OwnMapAsk& ask, const slam::Mapper& mapper, OwnMapNews& news) {
  for (const slam::KeyframeId& id : ask.poses_of)
    if (const auto node = mapper.node_of(id)) news.poses.emplace_back(id, mapper.poses()[*node]);
}

/// What the map was begun with: keyframes and relations of mates, and of this robot in earlier runs.
void add_held(const slam::Mapper& mapper, OwnMapNews& news) {
  for (const slam::KeyframePtr& keyframe : mapper.keyframes())
    if (keyframe->id.origin() != mapper.origin()) news.held.push_back(keyframe);
  news.held_relations = slam::found_relations(mapper.keyframes(), mapper.edges());
  std::erase_if(news.held_relations, [&](const auto& found) { return found.id.origin() == mapper.origin(); });
}

/// Of a map that may be thrown away: nothing new, but what it was begun with, and where mates are in it.
std::unique_ptr<OwnMapNews> news_on_trial(const OwnMapAsk& ask, const slam::Mapper& mapper,
                                          std::uint64_t map) {
  auto news = std::make_unique<OwnMapNews>();
  news->map = map;
  news->origin = mapper.origin();
  if (ask.map != map) add_held(mapper, *news);
  add_poses(ask, mapper, *news);
  return news;
}

std::unique_ptr<OwnMapNews> news_for(const OwnMapAsk& ask, const slam::Mapper& mapper, std::uint64_t map) {
  auto news = std::make_unique<OwnMapNews>();
  news->map = map;
  news->origin = mapper.origin();
  const bool is_same = ask.map == map;
  const auto way = mapper.own_way();
  const auto keyframes = mapper.keyframes();
  if (!is_same) add_held(mapper, *news);
  for (const std::size_t node : way.subspan(is_same ? std::min(ask.keyframes, way.size()) : 0))
    if (keyframes[node]->id.origin() == mapper.origin()) news->keyframes.push_back(keyframes[node]);
  news->own_way = way.size();
  const auto found = mapper.found_since(is_same ? ask.relations : 0);
  news->relations.assign(found.begin(), found.end());
  news->anchors = anchors_of(mapper);
  add_poses(ask, mapper, *news);
  return news;
}

}  // namespace

MappingTeam::MappingTeam(TeamHandOver& team, const slam::MapperParams& params)
    : team_(team),
      T_base_front_(params.T_base_laser),
      T_base_coronal_{params.coronal.x_m, params.coronal.y_m, 0.0} {}

void MappingTeam::serve(pipeline::MappingState& state, std::uint64_t map) {
  for (const auto* parcel = team_.mates.front(); parcel != nullptr; parcel = team_.mates.front()) {
    const std::unique_ptr<MatesMapNews> news = std::move(parcel->content);
    team_.mates.pop();
    if (news->map != map) continue;
    for (const auto& [key, relation] : news->known) state.relate(key, relation);
    state.join(news->keyframes, news->relations);
  }
  // While it is open whether the robot is where it was found, mates are given nothing of this map: it may be
  // thrown away.
  const slam::TrialVerdict verdict = state.trial().verdict;
  const bool is_open = verdict == slam::TrialVerdict::kRunning || verdict == slam::TrialVerdict::kDropped;
  for (const OwnMapAsk* ask = team_.asks.front(); ask != nullptr; ask = team_.asks.front()) {
    if (auto* slot = team_.own.try_acquire(); slot != nullptr) {
      slot->content = (is_open ? news_on_trial : news_for)(*ask, state.mapper(), map);
      team_.own.commit();
      team_.wakeup.post();
    }
    team_.asks.pop();
  }
}

std::vector<types::Vector2> MappingTeam::mates_near(const types::Se2& T_map_base, types::Stamp now) {
  std::vector<types::Vector2> near;
  const MatesPlaces* mates = team_.places.read();
  if (mates == nullptr) return near;
  for (const MatesPlaces::Place& place : mates->places) {
    if (now - place.heard <= team::RosterParams{}.place_age_max &&
        (place.p_map - T_map_base.translation()).norm() <= kSight_m)
      near.push_back(place.p_map);
  }
  return near;
}

const types::Scan* MappingTeam::without_mates_front(const types::Scan* scan, const types::Se2& T_map_base) {
  if (scan == nullptr) return nullptr;
  const std::vector<types::Vector2> near = mates_near(T_map_base, scan->arrival);
  if (near.empty()) return scan;
  front_ = *scan;
  team::mask_mates(front_, T_map_base * T_base_front_, near, team::RosterParams{}.mate_radius_m);
  return &front_;
}

const types::Scan* MappingTeam::without_mates_coronal(const types::Scan* scan, const types::Se2& T_map_base) {
  if (scan == nullptr) return nullptr;
  const std::vector<types::Vector2> near = mates_near(T_map_base, scan->arrival);
  if (near.empty()) return scan;
  coronal_ = *scan;
  team::mask_mates_coronal(coronal_, T_map_base * T_base_coronal_, near, team::RosterParams{}.mate_radius_m);
  return &coronal_;
}

}  // namespace topo::daemon
