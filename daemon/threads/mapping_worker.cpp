// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/threads/mapping_worker.hpp"

#include <utility>

#include "drivers/io/posix.hpp"

namespace topo::daemon {

MappingWorker::MappingWorker(HandOvers& hand_overs, const slam::MapperParams& params,
                             const slam::Origin& origin, Vitals& vitals, const types::Se2& start,
                             bool with_team)
    : hand_overs_(hand_overs), params_(params), maker_(origin), start_(start), vitals_(vitals) {
  if (with_team) team_.emplace(hand_overs.team, params);
  odometry_.reserve(kOdometryRing);
}

void MappingWorker::run() noexcept {
  auto state = std::make_unique<pipeline::MappingState>(params_, maker_, start_);
  publish(*state);
  while (!hand_overs_.ending.readers_gone.load(std::memory_order_acquire)) {
    hand_overs_.mapping.wakeup.wait(std::chrono::milliseconds(250));
    serve_desk(hand_overs_.journal.desk, *state, report_.map);
    // On a machine that is too slow the rings are never empty: the loop skips scans, reports and beats
    // nevertheless.
    bool more = true;
    while (more && !hand_overs_.ending.stopping.load(std::memory_order_acquire)) {
      take_over(state);
      more = serve(*state);
      // Before the desks are served: a client that learns of a map there must find it in the report too.
      hand_overs_.mapping.report.store(report_);
      serve_desk(hand_overs_.journal.desk, *state, report_.map);
      serve_desk(hand_overs_.files_desk, *state, report_.map);
      if (team_) team_->serve(*state, report_.map);
      vitals_.beat();
    }
  }
  take_over(state);                 // a late parcel is adopted, because this thread must destroy its nodes
  hand_overs_.mapping.map.reset();  // snapshots hold nodes of the states' arenas
  former_.clear();
}

/// Continues with the map that another thread prepared. The current one is destroyed when no reader uses it.
void MappingWorker::take_over(std::unique_ptr<pipeline::MappingState>& state) {
  for (const auto* parcel = hand_overs_.mapping.take_over.front(); parcel != nullptr;
       parcel = hand_overs_.mapping.take_over.front()) {
    std::unique_ptr<pipeline::MappingState> next = std::move(parcel->content);
    hand_overs_.mapping.take_over.pop();
    next->adopt();
    next->follow(state->revision());
    former_.push_back(std::exchange(state, std::move(next)));
    loops_.stale_until = loops_.asked;
    graphs_.stale_until = graphs_.asked;
    alignments_.stale_until = alignments_.asked;
    ++report_.map;
    note_trial(*state);
    publish(*state);
    hand_over_pose(*state, state->cloud().stamp, true);
  }
  if (!former_.empty() && hand_overs_.mapping.map->reclaim() == 0) former_.clear();
}

/// Processes all waiting answers and odometry, and the oldest scan of each scanner; false when there was
/// neither odometry nor a scan.
bool MappingWorker::serve(pipeline::MappingState& state) {
  take_answers(hand_overs_.closure.loop_answers, loops_, state);
  take_answers(hand_overs_.closure.graph_solutions, graphs_, state);
  take_answers(hand_overs_.closure.alignments, alignments_, state);
  skip_backlog(hand_overs_.front.to_mapping);
  skip_backlog(hand_overs_.coronal.to_mapping);
  take_odometry();
  return step(state);
}

template <class Answer, std::size_t N>
void MappingWorker::take_answers(sync::Ring<Answer, N>& ring, Questions& questions,
                                 pipeline::MappingState& state) {
  for (const Answer* answer = ring.front(); answer != nullptr; answer = ring.front()) {
    if (++questions.answered > questions.stale_until) state.offer(*answer);
    ring.pop();
  }
}

void MappingWorker::take_odometry() {
  odometry_.clear();
  for (auto* o = hand_overs_.base.odometry.front(); o != nullptr && odometry_.size() < kOdometryRing;
       o = hand_overs_.base.odometry.front()) {
    odometry_.push_back(*o);
    hand_overs_.base.odometry.pop();
  }
}

/// By the odometry that came last.
types::Se2 MappingWorker::place_now(const pipeline::MappingState& state) {
  if (!odometry_.empty()) T_odom_base_ = odometry_.back().T_odom_base.se2();
  return state.mapper().T_map_odom() * T_odom_base_;
}

/// One step with the oldest data; false when there were none.
bool MappingWorker::step(pipeline::MappingState& state) {
  auto& front_ring = hand_overs_.front.to_mapping;
  auto& coronal_ring = hand_overs_.coronal.to_mapping;
  pipeline::MappingInput input;
  input.odometry = odometry_;
  input.front = front_ring.front();
  input.coronal = coronal_ring.front();
  input.is_searching = hand_overs_.closure.alignment_queries.size() > 0;
  if (odometry_.empty() && input.front == nullptr && input.coronal == nullptr) return false;
  const types::Stamp begin = io::monotonic_now();
  if (input.front != nullptr) vitals_.wake.record((begin - input.front->arrival).count());
  if (team_) {
    const types::Se2 T_map_base = place_now(state);
    input.front = team_->without_mates_front(input.front, T_map_base);
    input.coronal = team_->without_mates_coronal(input.coronal, T_map_base);
  }
  const pipeline::MappingLosses before = state.losses();
  auto output = pipeline::mapping_step(state, input);
  report_.losses += state.losses() - before;
  if (input.front != nullptr) front_ring.pop();
  if (input.coronal != nullptr) coronal_ring.pop();
  use(state, output);
  if (!output.matches.empty()) vitals_.run.record((io::monotonic_now() - begin).count());
  return true;
}

void MappingWorker::skip_backlog(sync::Ring<types::Scan, kScanRing>& ring) {
  if (ring.size() > kBacklog) ring.skip_to_newest();  // the ring counts them
}

void MappingWorker::use(pipeline::MappingState& state, pipeline::MappingOutput& output) {
  for (const slam::MatchReport& match : output.matches) {
    ++(match.matched ? report_.matched : report_.lost);
    report_.degenerate += match.matched && match.match.degenerate ? 1U : 0U;
    report_.response = match.match.response;
    matched_ = plausibility::after_scan(matched_, match.stamp, match.T_previous_base, match.T_odom_base,
                                        match.matched);
  }
  note_trial(state);
  for (const slam::LoopVerdict& verdict : output.loop_verdicts) {
    report_.closures_accepted += static_cast<std::uint64_t>(verdict.accepted);
    report_.closures_rejected += static_cast<std::uint64_t>(verdict.rejected);
  }
  if (output.keyframe_added) publish(state);
  if (!output.matches.empty()) hand_overs_.mapping.to_base.store(matched_);
  if (!output.matches.empty())
    hand_over_pose(state, output.matches.back().stamp, output.matches.back().matched);
  // A full ring means that the search is slow: this query is dropped, and the next keyframe sends another.
  for (slam::LoopQuery& query : output.loop_queries)
    (void)ask(hand_overs_.closure.loop_queries, loops_, query);
  if (output.alignment_query)
    (void)ask(hand_overs_.closure.alignment_queries, alignments_, *output.alignment_query);
  if (output.graph_query && !ask(hand_overs_.closure.graph_queries, graphs_, *output.graph_query))
    state.offer(slam::GraphSolution{});
}

/// Before the pose and the report: the base must not hear of a map whose place is not known.
void MappingWorker::note_trial(const pipeline::MappingState& state) {
  report_.trial = state.trial();
  const bool dropped = report_.trial.verdict == slam::TrialVerdict::kDropped;
  hand_overs_.place.dropped.store(dropped, std::memory_order_release);
}

void MappingWorker::hand_over_pose(const pipeline::MappingState& state, types::Stamp stamp, bool matched) {
  report_.T_map_odom = types::Transform2<types::Map, types::Odom>(state.mapper().T_map_odom());
  hand_overs_.to_planning.tracked.store({stamp, report_.revision, report_.T_map_odom, matched});
}

/// False when the ring is full; the ring counts it.
template <class Query, std::size_t N>
bool MappingWorker::ask(sync::Ring<Query, N>& ring, Questions& questions, Query& query) {
  Query* slot = ring.try_acquire();
  if (slot == nullptr) return false;
  *slot = std::move(query);
  ring.commit();
  ++questions.asked;
  hand_overs_.closure.wakeup.post();
  return true;
}

void MappingWorker::publish(pipeline::MappingState& state) {
  std::unique_ptr<const pipeline::MapSnapshot> snapshot = state.make_snapshot();
  report_.revision = snapshot->revision;
  report_.keyframes = snapshot->keyframes.size();
  report_.keyframes_of_all = state.mapper().keyframes().size();
  hand_overs_.mapping.map->publish(std::move(snapshot));
}

}  // namespace topo::daemon
