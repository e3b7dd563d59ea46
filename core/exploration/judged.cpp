// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/exploration/judged.hpp"

#include <cmath>
#include <utility>

namespace topo::exploration {

namespace {

/// Least area for a second, of the goals that are judged.
double rate_m2ps(const ExplorationParams& params) {
  return params.finish == Finish::kWorth ? params.worth.rate_m2ps : params.worth.look_m2ps;
}

/// Expected area of a goal; without limit of one that is not judged.
double gain_m2(const Candidate& candidate, const ExplorationParams& params) {
  const Source source = candidate.id.source;
  const bool is_judged =
      source == Source::kViewpoint || (params.finish == Finish::kWorth && source != Source::kDoubt);
  return is_judged ? expected_area_m2(candidate.goal, params.worth.beyond_m2, params.tour) : HUGE_VAL;
}

/// The candidates that are not worth their time, by index.
std::vector<LeftOut> left_out(const Judged& all, const ExplorationParams& params) {
  std::vector<double> gains_m2(all.table.goals.count, 0.0);
  std::vector<std::size_t> of(all.table.goals.count, 0);
  for (std::size_t i = 0; i < all.candidates.size(); ++i) {
    if (!all.table.row[i]) continue;
    of[*all.table.row[i]] = i;
    gains_m2[*all.table.row[i]] = gain_m2(all.candidates[i], params);
  }
  WorthParams worth = params.worth;
  worth.rate_m2ps = rate_m2ps(params);
  std::vector<LeftOut> out = not_worth_it(all.table.goals, gains_m2, all.table.home_m, worth);
  for (LeftOut& left : out) left.goal = of[left.goal];
  return out;
}

Judged without(const std::vector<LeftOut>& out, Judged all) {
  std::vector<bool> is_out(all.candidates.size(), false);
  for (const LeftOut& left : out) {
    is_out[left.goal] = true;
    all.left_out.push_back({all.candidates[left.goal].goal.p_map, left.gain_m2, left.time_s});
  }
  Judged kept{{}, {{}, std::move(all.table.goals), all.table.home_m}, std::move(all.left_out)};
  for (std::size_t i = 0; i < is_out.size(); ++i) {
    if (is_out[i]) continue;
    kept.candidates.push_back(all.candidates[i]);
    kept.table.row.push_back(all.table.row[i]);
  }
  return kept;
}

}  // namespace

Judged judged(std::vector<Candidate> candidates, const Candidate* present, const Situation& situation,
              Searches searches, const ExplorationParams& params) {
  Judged all{std::move(candidates), {}, {}};
  const bool tours = row_of(params.strategy).tours;
  if (!tours && params.finish != Finish::kWorth) {
    all.table.row.resize(all.candidates.size());
    return all;
  }
  all.table = travel_table(all.candidates, present, situation.start, searches, params.tour);
  if (params.finish == Finish::kEssential) return all;
  const std::vector<LeftOut> out = left_out(all, params);
  return without(out, std::move(all));
}

}  // namespace topo::exploration
