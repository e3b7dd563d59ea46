// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <deque>
#include <optional>
#include <utility>

#include "core/slam/known_starts.hpp"
#include "core/slam/team_alignment.hpp"
#include "tests/bench/topobench/explore/map_source.hpp"

namespace topo::bench {
namespace {

class SlamSource final : public SharedMapSource {
 public:
  SlamSource(const slam::MapperParams& params, int closure_delay_scans, SlamTeam team)
      : delay_(static_cast<std::uint64_t>(closure_delay_scans)),
        team_(std::move(team)),
        state_(params, team_.origin, start_of(team_, team_.origin.robot)) {
    snapshot_ = state_.make_snapshot();
  }

  void take(const Readings& readings) override {
    for (const types::BaseState& state : readings.states)
      use(mapping_step(state_, {{&state.odometry, 1}, nullptr, nullptr}));
    for (const types::Scan& scan : readings.coronal) use(mapping_step(state_, {{}, nullptr, &scan}));
    for (const types::Scan& scan : readings.front) {
      ++scans_;
      for (; !answers_.empty() && answers_.front().due <= scans_; answers_.pop_front())
        state_.offer(std::move(answers_.front().answer));
      for (; !alignments_.empty() && alignments_.front().first <= scans_; alignments_.pop_front())
        state_.offer(alignments_.front().second);
      if (solution_ && solution_->first <= scans_) {
        state_.offer(std::move(solution_->second));
        solution_.reset();
      }
      use(mapping_step(state_, {{}, &scan, nullptr}));
    }
  }

  [[nodiscard]] const pipeline::MapSnapshot& map() const override { return *snapshot_; }
  [[nodiscard]] const pipeline::TrackedPose& tracked() const override { return tracked_; }
  [[nodiscard]] const plausibility::MatchedMotion* matched() const override { return &matched_; }

  void join(const TeamNews& news) override {
    for (const slam::KeyframePtr& theirs : news.keyframes) meet(theirs->id);
    state_.join(news.keyframes, news.relations);
  }

  TeamNews take_new() override {
    TeamNews news;
    const slam::Mapper& mapper = state_.mapper();
    for (const std::size_t node : mapper.own_way().subspan(keyframes_told_))
      news.keyframes.push_back(mapper.keyframes()[node]);
    keyframes_told_ += news.keyframes.size();
    const auto found = mapper.found_since(relations_told_);
    news.relations.assign(found.begin(), found.end());
    relations_told_ += static_cast<std::uint32_t>(found.size());
    return news;
  }

  [[nodiscard]] const types::Se2& T_map_base() const override { return state_.mapper().T_map_base(); }
  [[nodiscard]] const types::Se2* find_pose(const slam::KeyframeId& id) const override {
    const auto node = state_.mapper().node_of(id);
    return node ? &state_.mapper().poses()[*node] : nullptr;
  }
  [[nodiscard]] std::optional<types::Se2> T_map_mates(std::uint16_t robot) const override {
    // Of every map the first keyframe stays where its origin's robot started.
    const types::Se2* first = find_pose({robot, 0});
    if (first != nullptr) return *first * start_of(team_, robot).inverse();
    return team_.starts.empty() ? std::nullopt : std::optional(types::Se2{});
  }

 private:
  struct Waiting {
    std::uint64_t due;
    slam::LoopAnswer answer;
  };

  static types::Se2 start_of(const SlamTeam& team, std::uint16_t robot) {
    return robot < team.starts.size() ? team.starts[robot] : types::Se2{};
  }

  /// A team-mate's first keyframe: where it is from this robot's is known.
  void meet(const slam::KeyframeId& id) {
    if (team_.starts.empty() || id.sequence != 0) return;
    const slam::KeyframeId own{team_.origin.robot, 0, team_.origin.run};
    const auto known = slam::known_starts(own, start_of(team_, own.robot), id, start_of(team_, id.robot));
    state_.relate(known.first, known.second);
  }

  void use(pipeline::MappingOutput output) {
    if (output.keyframe_added) snapshot_ = state_.make_snapshot();
    for (const slam::MatchReport& match : output.matches) {
      matched_ = plausibility::after_scan(matched_, match.stamp, match.T_previous_base, match.T_odom_base,
                                          match.matched);
    }
    if (!output.matches.empty()) {
      tracked_.stamp = output.matches.back().stamp;
      tracked_.revision = snapshot_->revision;
      tracked_.T_map_odom = types::Transform2<types::Map, types::Odom>(state_.mapper().T_map_odom());
      tracked_.matched = output.matches.back().matched;
    }
    for (const slam::LoopQuery& query : output.loop_queries)
      answers_.push_back({scans_ + delay_, slam::find_closures(query)});
    if (output.graph_query) solution_.emplace(scans_ + delay_, slam::solve_graph(*output.graph_query));
    if (output.alignment_query)
      alignments_.emplace_back(scans_ + delay_, slam::align_maps(*output.alignment_query));
  }

  std::uint64_t delay_;
  std::uint64_t scans_ = 0;
  SlamTeam team_;
  pipeline::MappingState state_;
  std::unique_ptr<pipeline::MapSnapshot> snapshot_;  // after state_: it must go first
  pipeline::TrackedPose tracked_;
  plausibility::MatchedMotion matched_;
  std::deque<Waiting> answers_;
  std::deque<std::pair<std::uint64_t, slam::Alignment>> alignments_;       ///< with when they are due
  std::optional<std::pair<std::uint64_t, slam::GraphSolution>> solution_;  ///< the same
  std::size_t keyframes_told_ = 0;
  std::uint32_t relations_told_ = 0;
};

}  // namespace

std::unique_ptr<SharedMapSource> make_slam_source(const slam::MapperParams& params, int closure_delay_scans,
                                                  SlamTeam team) {
  return std::make_unique<SlamSource>(params, closure_delay_scans, std::move(team));
}

}  // namespace topo::bench
