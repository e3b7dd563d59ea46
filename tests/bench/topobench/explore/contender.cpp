// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/explore/contender.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>

namespace topo::bench {
namespace {

using exploration::Strategy;
using pipeline::PlannerParams;

void drop_walls(PlannerParams& planner) { planner.analysis.wall_store = false; }
void share_single_goals(PlannerParams& planner) { planner.explore.rule = team::Rule::kNoClusters; }
void share_clusters(PlannerParams& planner) { planner.explore.rule = team::Rule::kClusters; }
void fill_gaps_in_turn(PlannerParams& planner) { planner.explore.tour.now_share = -1.0; }
void look_everywhere(PlannerParams& planner) { planner.explore.worth.look_m2ps = 1e-9; }
void stay_out(PlannerParams& planner) { planner.explore.ending.stays_out = true; }

/// No reason is left against any merge, so that the reduction ends with one place for what hangs together.
void drop_places(PlannerParams& planner) {
  places::PlaceParams& places = planner.analysis.places;
  places.density.min = 0.0;
  places.width_ratio_max = HUGE_VAL;
  places.narrow_ratio = 0.0;
  places.wall_share_max = HUGE_VAL;
}

constexpr std::array kStrategies{Strategy::kTopometric, Strategy::kNearestFrontier, Strategy::kGreedyFrontier,
                                 Strategy::kUtilityFrontier, Strategy::kMinPos};

struct Ablation {
  std::string_view name;
  void (*drop)(PlannerParams&);
};
constexpr std::array<Ablation, 7> kAblations{{{"topometric_no_walls", drop_walls},
                                              {"topometric_gaps_in_turn", fill_gaps_in_turn},
                                              {"topometric_all_looks", look_everywhere},
                                              {"topometric_stays_out", stay_out},
                                              {"topometric_kmeans", share_clusters},
                                              {"topometric_no_kmeans", share_single_goals},
                                              {"topometric_no_places", drop_places}}};

}  // namespace

std::vector<std::string> contender_names() {
  std::vector<std::string> names;
  for (const Strategy strategy : kStrategies) names.emplace_back(to_text(strategy));
  for (const Ablation& ablation : kAblations) names.emplace_back(ablation.name);
  return names;
}

types::Status set_contender(std::string_view name, PlannerParams& planner) {
  for (const Ablation& ablation : kAblations) {
    if (ablation.name != name) continue;
    planner.explore.strategy = Strategy::kTopometric;
    ablation.drop(planner);
    return {};
  }
  const auto strategy = exploration::strategy_of(name);
  if (!strategy)
    return types::fail(types::Errc::kInvalidInput, fmt::format("strategy: found '{}', expected one of {}",
                                                               name, fmt::join(contender_names(), ", ")));
  planner.explore.strategy = *strategy;
  return {};
}

}  // namespace topo::bench
