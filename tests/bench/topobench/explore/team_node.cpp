// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/explore/team_node.hpp"

#include <utility>

#include "core/team/masked_scan.hpp"
#include "core/team/roster.hpp"
#include "core/types/invariant.hpp"

namespace topo::bench {
namespace {

/// Without a message from a robot it is taken to stand at its start so long.
constexpr types::Duration kAtStart = std::chrono::seconds(30);

team::ExchangeParams params_of(std::uint16_t robot) {
  team::ExchangeParams params;
  params.periods.seed = robot + 1U;
  return params;
}

}  // namespace

TeamNode::TeamNode(std::uint16_t robot, SharedMapSource& source, const slam::MapperParams& mapping,
                   std::vector<types::Se2> starts)
    : robot_(robot),
      source_(source),
      T_base_front_(mapping.T_base_laser),
      T_base_coronal_(mapping.coronal.x_m, mapping.coronal.y_m, 0.0),
      starts_(std::move(starts)),
      exchange_({team::team_hash("topobench"), robot, 0}, params_of(robot)) {}

std::vector<types::Vector2> TeamNode::mates_at(types::Stamp now) const {
  std::vector<types::Vector2> places;
  for (const auto& [id, mate] : mates_) {
    if (now - mate.heard <= team::RosterParams{}.place_age_max) places.push_back(mate.p_map);
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
      mask_scan(scans[i], T_map_base * T_base_laser, mates_at(now), team::RosterParams{}.mate_radius_m);
    }
  };
  mask(readings.front, T_base_front_, team::mask_mates);
  mask(readings.coronal, T_base_coronal_, team::mask_mates_coronal);
}

pipeline::TeamInput TeamNode::heard() {
  outbox_ = std::exchange(inbox_, {});
  return {robot_, outbox_};
}

std::vector<team::Datagram> TeamNode::exchange(types::Stamp now) {
  take_news(now);
  give_own();
  return exchange_.datagrams(now);
}

void TeamNode::give_own() {
  const TeamNews own = source_.take_new();
  for (const slam::KeyframePtr& keyframe : own.keyframes) {
    types::require(exchange_.add_keyframe(*keyframe).has_value(), "team node: an own keyframe");
    own_.push_back(keyframe);
  }
  for (const slam::FoundRelation& found : own.relations)
    types::require(exchange_.add_relation(found).has_value(), "team node: an own relation");
  if (!said_) return;
  said_->T_map_base = source_.T_map_base();
  exchange_.say(*said_);
}

void TeamNode::take_news(types::Stamp now) {
  team::ExchangeNews news = exchange_.take_news(now);
  if (const TeamNews theirs{std::move(news.keyframes), std::move(news.relations)}; !theirs.empty())
    source_.join(theirs);
  for (const team::HeardStatus& status : news.statuses) {
    const std::uint16_t mate = status.message.robot;
    const auto T_map_mates = source_.T_map_mates(mate);
    if (!T_map_mates) continue;
    inbox_.push_back(team::in_frame(*T_map_mates, status.message));
    mates_[mate] = {inbox_.back().T_map_base.translation(), status.heard};
  }
}

}  // namespace topo::bench
