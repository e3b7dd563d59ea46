// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/threads/planning_worker.hpp"

#include <algorithm>
#include <utility>

#include "daemon/logging/event_catalogue.hpp"
#include "drivers/io/posix.hpp"

namespace topo::daemon {

void PlanningWorker::run() noexcept {
  {
    MapSnapshots::Reader maps = hand_overs_.mapping.map->reader(kPlanningReader);
    pipeline::PlanningState state(params_);
    Period period(io::monotonic_now() + period_, period_);
    while (!hand_overs_.ending.stopping.load(std::memory_order_acquire)) {
      const types::Duration left = period.next() - io::monotonic_now();
      hand_overs_.to_planning.wakeup.wait(std::max(left, types::Duration::zero()));
      vitals_.beat();
      if (hand_overs_.ending.stopping.load(std::memory_order_acquire)) break;
      const types::Stamp begin = io::monotonic_now();
      const bool due = begin >= period.next();
      if (due) vitals_.wake.record((begin - period.next()).count());
      decide(state, maps);
      const types::Stamp end = io::monotonic_now();
      vitals_.run.record((end - begin).count());
      note_budget(begin, end);
      if (due) vitals_.add_overruns(period.advance(end));
      vitals_.beat();
    }
  }
  hand_overs_.planning.reset();
}

void PlanningWorker::decide(pipeline::PlanningState& state, MapSnapshots::Reader& maps) {
  const MapSnapshots::Pin map = maps.pin();
  if (const auto* mission = hand_overs_.to_planning.mission.take_new(); mission != nullptr)
    mission_ = *mission;
  pipeline::PlanningInput input;
  input.map = map.get();
  input.tracked = hand_overs_.to_planning.tracked.read();
  input.control = hand_overs_.to_planning.control.read();
  input.front = hand_overs_.front.to_planning.read();
  input.mission = mission_;
  input.area = hand_overs_.to_planning.area.read();
  if (const auto* first = hand_overs_.to_planning.here_first.read(); first != nullptr)
    input.here_first = *first;
  if (const auto* doubted = hand_overs_.to_planning.doubted.read(); doubted != nullptr)
    input.doubted = *doubted;
  input.team.robot = robot_;
  if (const auto* heard = hand_overs_.team.statuses.take_new(); heard != nullptr)
    input.team.messages = *heard;
  input.now = io::monotonic_now();  // after everything was taken: nothing in the input is from the future
  pipeline::PlanningOutput output = pipeline::planning_step(state, input);
  hand_overs_.plan.store(output.plan);
  if (robot_ != kNoTeam) {
    hand_overs_.team.status.store(output.message);
    hand_overs_.team.wakeup.post();
  }
  hand_overs_.planning->publish(std::move(output.report));
}

void PlanningWorker::note_budget(types::Stamp begin, types::Stamp end) {
  // The base goes on by the last plan until it is too old.
  if (end - begin <= period_) return;
  ++slow_;
  if (!told_slow_.due(end)) return;
  post(vitals_.events, end.time_since_epoch().count(), EventId::kPlanningSlow, sync::Severity::kWarning,
       {(end - begin).count(), period_.count(), slow_});
}

}  // namespace topo::daemon
