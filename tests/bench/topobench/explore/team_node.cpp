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

void TeamNode::gather() {
  exchange_.add_own(source_.take_new());
  if (!said_) return;
  said_->T_map_base = source_.T_map_base();
  said_->sequence = ++messages_;
}

Letter TeamNode::letter_to(std::uint16_t other) const {
  return exchange_.letter_to(other, said_, [&](const slam::KeyframeId& id) { return source_.find_pose(id); });
}

void TeamNode::take(std::uint16_t from, const Letter& letter, types::Stamp now) {
  if (const TeamNews news = exchange_.take(from, letter); !news.empty()) source_.join(news);
  const auto T_map_mates = source_.T_map_mates(from);
  if (!letter.message || !T_map_mates) return;
  inbox_.push_back(team::in_frame(*T_map_mates, *letter.message));
  mates_[from] = {inbox_.back().T_map_base.translation(), now};
}

}  // namespace topo::bench
