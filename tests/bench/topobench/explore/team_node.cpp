// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/explore/team_node.hpp"

#include <utility>

#include "core/team/masked_scan.hpp"
#include "core/team/roster.hpp"

namespace topo::bench {
namespace {

/// Without a message from a robot it is taken to stand at its start so long.
constexpr types::Duration kAtStart = std::chrono::seconds(30);
constexpr std::size_t kKeyframesInLetter = 20;
constexpr std::size_t kRelationsInLetter = 60;  // some keyframes have two or three

/// What was said in one map's frame, in another's.
team::StatusMessage in_frame(const types::Se2& T_map_mates, team::StatusMessage message) {
  const auto move = [&](types::Vector2& p) { p = T_map_mates * p; };
  message.T_map_base = T_map_mates * message.T_map_base;
  move(message.start);
  if (message.home) move(*message.home);
  if (message.claim) move(message.claim->p_map);
  for (team::Bid& bid : message.bids) move(bid.p_map);
  for (types::Vector2& place : message.visited) move(place);
  for (types::Vector2& opening : message.looked) move(opening);
  for (types::Vector2& point : message.way_map) move(point);
  return message;
}

}  // namespace

TeamNode::TeamNode(std::uint16_t robot, SharedMapSource& source, const slam::MapperParams& mapping,
                   std::vector<types::Se2> starts)
    : robot_(robot),
      source_(source),
      T_base_front_(mapping.T_base_laser),
      T_base_coronal_(mapping.coronal.x_m, mapping.coronal.y_m, 0.0),
      starts_(std::move(starts)) {}

std::vector<types::Vector2> TeamNode::mates_at(types::Stamp now) const {
  std::vector<types::Vector2> places;
  for (const auto& [id, mate] : mates_) {
    if (now - mate.heard <= team::kPlaceAgeMax) places.push_back(mate.p_map);
  }
  for (std::uint16_t id = 0; id < starts_.size() && now <= types::Stamp{kAtStart}; ++id) {
    if (id != robot_ && !mates_.contains(id)) places.push_back(starts_[id].translation());
  }
  return places;
}

void TeamNode::mask_mates(Readings& readings) {
  if (!readings.states.empty()) T_odom_base_ = readings.states.back().odometry.T_odom_base;
  const types::Se2 by_odometry = (source_.tracked().T_map_odom * T_odom_base_).se2();
  const auto mask = [&](std::vector<types::Scan>& scans, const types::Se2& T_base_laser, auto mask_scan) {
    for (std::size_t i = 0; i < scans.size(); ++i) {
      const bool posed = i < readings.poses.size();
      const types::Se2& T_map_base = posed ? readings.poses[i].T_map_base : by_odometry;
      const types::Stamp now = posed ? readings.poses[i].stamp : scans[i].arrival;
      mask_scan(scans[i], T_map_base * T_base_laser, mates_at(now), team::kMateRadius_m);
    }
  };
  mask(readings.front, T_base_front_, team::mask_mates);
  mask(readings.coronal, T_base_coronal_, team::mask_mates_coronal);
}

pipeline::TeamInput TeamNode::heard() {
  outbox_ = std::exchange(inbox_, {});
  return {robot_, outbox_};
}

void TeamNode::gather() {
  const TeamNews own = source_.take_new();
  for (const PosedKeyframe& keyframe : own.keyframes) set_.insert(keyframe.keyframe);
  for (const slam::FoundRelation& found : own.relations) log_.insert(found);
  if (!said_) return;
  said_->T_map_base = source_.T_map_base();
  said_->sequence = ++messages_;
}

Letter TeamNode::letter_to(std::uint16_t other) const {
  Letter letter;
  letter.message = said_;
  letter.keyframe_counts = set_.counts();
  letter.relation_counts = log_.counts();
  const auto at = there_.find(other);
  const Counts there = at != there_.end() ? at->second : Counts{};
  for (const slam::KeyframePtr& keyframe : set_.missing(there.keyframes, kKeyframesInLetter)) {
    const types::Se2* pose = source_.find_pose(keyframe->id);
    letter.news.keyframes.push_back({keyframe, pose != nullptr ? *pose : types::Se2{}});
  }
  letter.news.relations = log_.missing(there.relations, kRelationsInLetter);
  return letter;
}

void TeamNode::take(std::uint16_t from, const Letter& letter, types::Stamp now) {
  there_[from] = {letter.keyframe_counts, letter.relation_counts};
  TeamNews news;
  for (const PosedKeyframe& theirs : letter.news.keyframes) {
    if (set_.insert(theirs.keyframe)) news.keyframes.push_back(theirs);
  }
  for (const slam::FoundRelation& theirs : letter.news.relations) {
    if (log_.insert(theirs)) news.relations.push_back(theirs);
  }
  if (!news.keyframes.empty() || !news.relations.empty()) source_.join(news);
  const auto T_map_mates = source_.T_map_mates(from);
  if (!letter.message || !T_map_mates) return;
  inbox_.push_back(in_frame(*T_map_mates, *letter.message));
  mates_[from] = {inbox_.back().T_map_base.translation(), now};
}

}  // namespace topo::bench
