// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/pipeline/planning_step.hpp"

namespace topo::pipeline {

struct PlanningState::Impl {
  explicit Impl(const PlannerParams& given) : params(given) {}
  PlannerParams params;
  std::uint64_t sequence = 0;
};

PlanningState::PlanningState(const PlannerParams& params) : impl_(std::make_unique<Impl>(params)) {}
PlanningState::~PlanningState() = default;

PlanningOutput planning_step(PlanningState& state, const PlanningInput& input) {
  PlanningOutput out;
  out.plan.stamp = input.now;
  out.plan.sequence = ++state.impl_->sequence;
  auto report = std::make_unique<PlanningReport>();
  report->sequence = out.plan.sequence;
  report->stamp = input.now;
  out.report = std::move(report);
  return out;
}

types::Status check_target(const Analysis&, const PlannerParams&, const types::Vector2&,
                           const types::Vector2&) {
  return types::fail(types::Errc::kUnsupported, "no route search yet");
}

std::string_view to_text(Strategy strategy) {
  return strategy == Strategy::kTopometric ? "topometric" : "nearest_frontier";
}

std::string_view to_text(Finish finish) { return finish == Finish::kEssential ? "essential" : "complete"; }

}  // namespace topo::pipeline
