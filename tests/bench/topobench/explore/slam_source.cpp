// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <deque>
#include <utility>

#include "tests/bench/topobench/explore/map_source.hpp"

namespace topo::bench {
namespace {

class SlamSource final : public MapSource {
 public:
  SlamSource(const slam::MapperParams& params, int closure_delay_scans)
      : delay_(static_cast<std::uint64_t>(closure_delay_scans)), state_(params) {
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
      use(mapping_step(state_, {{}, &scan, nullptr}));
    }
  }

  [[nodiscard]] const pipeline::MapSnapshot& map() const override { return *snapshot_; }
  [[nodiscard]] const pipeline::TrackedPose& tracked() const override { return tracked_; }

 private:
  struct Waiting {
    std::uint64_t due;
    slam::LoopAnswer answer;
  };

  void use(pipeline::MappingOutput output) {
    if (output.keyframe_added) snapshot_ = state_.make_snapshot();
    if (!output.matches.empty()) {
      tracked_.stamp = output.matches.back().stamp;
      tracked_.revision = snapshot_->revision;
      tracked_.T_map_odom = types::Transform2<types::Map, types::Odom>(state_.mapper().T_map_odom());
      tracked_.matched = output.matches.back().matched;
    }
    for (const slam::LoopQuery& query : output.loop_queries)
      answers_.push_back({scans_ + delay_, slam::find_closures(query)});
  }

  std::uint64_t delay_;
  std::uint64_t scans_ = 0;
  pipeline::MappingState state_;
  std::unique_ptr<pipeline::MapSnapshot> snapshot_;  // after state_: it must go first
  pipeline::TrackedPose tracked_;
  std::deque<Waiting> answers_;
};

}  // namespace

std::unique_ptr<MapSource> make_slam_source(const slam::MapperParams& params, int closure_delay_scans) {
  return std::make_unique<SlamSource>(params, closure_delay_scans);
}

}  // namespace topo::bench
