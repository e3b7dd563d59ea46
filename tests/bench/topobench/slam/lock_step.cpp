// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/slam/lock_step.hpp"

#include <utility>

#include "core/slam/team_alignment.hpp"
#include "tests/bench/topobench/stopwatch.hpp"

namespace topo::bench {
StageTimer::StageTimer()
    : cpu_s_(seconds_of(CLOCK_THREAD_CPUTIME_ID)), wall_s_(seconds_of(CLOCK_MONOTONIC)) {}

void StageTimer::stop(std::initializer_list<StageTimes*> stages) const {
  const double cpu_ms = 1e3 * (seconds_of(CLOCK_THREAD_CPUTIME_ID) - cpu_s_);
  const double wall_ms = 1e3 * (seconds_of(CLOCK_MONOTONIC) - wall_s_);
  for (StageTimes* stage : stages) {
    stage->cpu_ms.push_back(cpu_ms);
    stage->wall_ms.push_back(wall_ms);
  }
}

void LockStep::step(const pipeline::MappingInput& input) {
  while (!answers_.empty() && answers_.front().due <= keyframes_) hand_over();
  for (; !alignments_.empty() && alignments_.front().first <= keyframes_; alignments_.pop_front())
    state_.offer(alignments_.front().second);
  if (solution_ && solution_->first <= keyframes_) {
    state_.offer(std::move(solution_->second));
    solution_.reset();
  }
  const StageTimer timer;
  const pipeline::MappingOutput output = mapping_step(state_, input);
  if (!output.matches.empty()) {
    timer.stop({&run_.step, output.corrected        ? &run_.correction
                            : output.keyframe_added ? &run_.keyframe
                                                    : &run_.track});
    const auto scans = static_cast<double>(output.matches.size());
    run_.scan.cpu_ms.insert(run_.scan.cpu_ms.end(), output.matches.size(), run_.step.cpu_ms.back() / scans);
    run_.scan.wall_ms.insert(run_.scan.wall_ms.end(), output.matches.size(),
                             run_.step.wall_ms.back() / scans);
  }
  collect(output);
}

MappingRun LockStep::finish() {
  while (!answers_.empty()) hand_over();
  for (; !alignments_.empty(); alignments_.pop_front()) state_.offer(alignments_.front().second);
  const StageTimer timer;
  const pipeline::MappingOutput output = state_.finish();
  timer.stop({&run_.end});
  collect(output);
  look_back();
  const std::span<const types::Se2> poses = state_.mapper().poses();
  for (std::size_t i = 0; i < run_.hung.size(); ++i) {
    const Hung& hung = run_.hung[i];
    run_.trajectory.push_back({run_.live[i].stamp_s, poses[hung.node] * hung.T_node_base});
  }
  return std::move(run_);
}

void LockStep::collect(const pipeline::MappingOutput& output) {
  for (const slam::MatchReport& match : output.matches) {
    run_.hung.push_back({match.node, match.T_node_base});
    run_.live.push_back({types::to_seconds(match.stamp.time_since_epoch()), match.T_map_base});
    keyframes_ += match.keyframe ? 1 : 0;
    run_.lost += match.matched ? 0 : 1;
    run_.searched += match.searched ? 1 : 0;
    run_.degenerate += match.matched && match.match.degenerate ? 1 : 0;
    if (on_match) on_match(match);
  }
  for (const slam::LoopVerdict& verdict : output.loop_verdicts) {
    run_.closures_accepted += verdict.accepted;
    run_.closures_rejected += verdict.rejected;
  }
  for (const slam::LoopQuery& query : output.loop_queries) {
    const StageTimer timer;
    slam::LoopAnswer answer = slam::find_closures(query);
    timer.stop({&run_.loop_search});
    answers_.push_back({keyframes_ + answer_delay_, std::move(answer)});
  }
  if (output.graph_query) {
    const StageTimer timer;
    solution_.emplace(keyframes_ + answer_delay_, slam::solve_graph(*output.graph_query));
    timer.stop({&run_.graph});
  }
  if (!output.alignment_query) return;
  alignments_.emplace_back(keyframes_ + answer_delay_, align(*output.alignment_query));
}

slam::Alignment LockStep::align(const slam::AlignmentQuery& query) {
  const StageTimer timer;
  slam::Alignment alignment = slam::align_maps(query);
  timer.stop({&run_.loop_search});
  if (on_alignment) on_alignment(alignment);
  return alignment;
}

void LockStep::look_back() {
  while (const auto query = state_.take_idle_query()) {
    const slam::Alignment alignment = align(*query);
    if (!alignment.found()) continue;
    state_.offer(alignment);
    collect(state_.finish());
  }
}

void LockStep::hand_over() {
  state_.offer(std::move(answers_.front().answer));
  answers_.pop_front();
}

}  // namespace topo::bench
