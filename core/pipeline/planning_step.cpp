// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/pipeline/planning_step.hpp"

#include <utility>

#include "core/pipeline/perceive.hpp"
#include "core/pipeline/planning_memory.hpp"
#include "core/pipeline/planning_report.hpp"
#include "core/pipeline/replan.hpp"

namespace topo::pipeline {

namespace {

Memory first_memory(const PlannerParams& params) {
  Memory memory;
  memory.team.roster = team::Roster(params.roster);
  memory.intent.deferred = exploration::DeferredGoals(params.explore.deferral);
  memory.intent.sweep.sweep = exploration::FinalSweep(params.explore.final_sweep);
  memory.intent.contact = team::LastContact(params.contact_lost_s);
  memory.intent.obstacles = travel::ObstacleMemory(params.obstacles);
  return memory;
}

/// The route of a new mission: none is held.
HeldRoute no_route(const HeldRoute& before) {
  HeldRoute route;
  route.newest = before.newest;
  return route;
}

}  // namespace

struct PlanningState::Impl {
  explicit Impl(const PlannerParams& given) : params(given), caches(params), memory(first_memory(params)) {}

  PlannerParams params;
  Caches caches;
  Memory memory;
};

PlanningState::PlanningState(const PlannerParams& params) : impl_(std::make_unique<Impl>(params)) {}
PlanningState::~PlanningState() = default;

PlanningOutput planning_step(PlanningState& state, const PlanningInput& in) {
  const PlannerParams& params = state.impl_->params;
  Caches& caches = state.impl_->caches;
  Memory before = std::move(state.impl_->memory);

  const bool is_new = in.mission.number != before.mission;
  const types::Duration elapsed = is_new || before.sequence == 0 ? types::Duration{} : in.now - before.now;
  if (is_new) caches.ways.doubt();
  Battery battery = is_new ? Battery{false, before.battery.low_since} : before.battery;
  HeldRoute route = is_new ? no_route(before.route) : std::move(before.route);
  exploration::Intent intent = ordered(std::move(before.intent), before.mission, in);
  auto [mates, contact] = heard({std::move(before.team), intent.contact}, in, before.place.here());
  intent.contact = contact;
  Whereabouts place = locate(std::move(before.place), in, params.whereabouts);
  const exploration::TeamView team{in.team.robot, mates.roster, mates.going_at};
  types::MapAnchors anchors = std::move(before.anchors);
  const bool touched = place.missing.empty() && in.control->touches != before.touches;
  Planned plan{std::move(intent), std::move(before.analysed), std::move(route)};
  if (!place.missing.empty() || std::holds_alternative<exploration::Paused>(plan.intent.phase))
    plan.intent = held_up(std::move(plan.intent), elapsed);
  if (!place.missing.empty()) {
    plan.intent.pursuit.has_target = false;  // no planning is possible; the mission continues later
  } else {
    const auto correction =
        anchors.take(in.map->keyframes, params.hold.correction_m, params.hold.correction_rad);
    if (correction) plan.intent = moved(std::move(plan.intent), *correction);
    battery = watched(battery, *in.control, params.battery, in.now);
    plan.intent = felt(std::move(plan.intent), in, place, mates.going_at, touched, params);
    plan = planned(std::move(plan), in, place, team, battery.low, caches, params);
  }

  PlanningOutput out;
  const std::uint64_t sequence = before.sequence + 1;
  out.plan = make_plan(sequence, in, plan.intent, place, plan.route.points, team, params);
  std::unique_ptr<PlanningReport> report = make_report(in, plan.intent, place, plan.route.points);
  report->sequence = sequence;
  report->known_m2 = caches.map.known_m2();
  report->analysis = plan.analysed.analysis;
  report->area = caches.map.area();
  out.report = std::move(report);
  out.message = make_message(in, plan.intent, place, plan.route.points, params);
  out.message.sequence = sequence;
  state.impl_->memory = {sequence,
                         in.now,
                         in.mission.number,
                         std::move(place),
                         std::move(anchors),
                         std::move(mates),
                         std::move(plan.intent),
                         std::move(plan.analysed),
                         std::move(plan.route),
                         battery,
                         touched ? in.control->touches : before.touches};
  return out;
}

}  // namespace topo::pipeline
