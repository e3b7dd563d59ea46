// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/team/exchange.hpp"

namespace topo::team {

void Exchange::add_own(const News& news) {
  for (const PosedKeyframe& keyframe : news.keyframes) keyframes_.insert(keyframe.keyframe);
  for (const slam::FoundRelation& found : news.relations) relations_.insert(found);
}

Letter Exchange::letter_to(std::uint16_t robot, const std::optional<StatusMessage>& message,
                           const PoseOf& pose_of) const {
  Letter letter;
  letter.message = message;
  letter.keyframe_counts = keyframes_.counts();
  letter.relation_counts = relations_.counts();
  const auto at = there_.find(robot);
  const Counts there = at != there_.end() ? at->second : Counts{};
  for (const slam::KeyframePtr& keyframe : keyframes_.missing(there.keyframes, params_.keyframes_in_letter)) {
    const types::Se2* pose = pose_of(keyframe->id);
    letter.news.keyframes.push_back({keyframe, pose != nullptr ? *pose : types::Se2{}});
  }
  letter.news.relations = relations_.missing(there.relations, params_.relations_in_letter);
  return letter;
}

News Exchange::take(std::uint16_t from, const Letter& letter) {
  there_[from] = {letter.keyframe_counts, letter.relation_counts};
  News news;
  for (const PosedKeyframe& theirs : letter.news.keyframes) {
    if (keyframes_.insert(theirs.keyframe)) news.keyframes.push_back(theirs);
  }
  for (const slam::FoundRelation& theirs : letter.news.relations) {
    if (relations_.insert(theirs)) news.relations.push_back(theirs);
  }
  return news;
}

StatusMessage in_frame(const types::Se2& T_map_mates, StatusMessage message) {
  const auto move = [&](types::Vector2& p) { p = T_map_mates * p; };
  message.T_map_base = T_map_mates * message.T_map_base;
  move(message.start);
  if (message.home) move(*message.home);
  if (message.claim) move(message.claim->p_map);
  for (Bid& bid : message.bids) move(bid.p_map);
  for (types::Vector2& place : message.visited) move(place);
  for (types::Vector2& opening : message.looked) move(opening);
  for (types::Vector2& point : message.way_map) move(point);
  return message;
}

}  // namespace topo::team
