// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cstdio>
#include <utility>

#include "core/exploration/choice.hpp"
#include "core/exploration/here_first.hpp"
#include "core/exploration/intent.hpp"
#include "core/exploration/judged.hpp"
#include "core/exploration/look_behind.hpp"
#include "core/exploration/remains.hpp"
#include "core/exploration/sources.hpp"
#include "core/exploration/stuck.hpp"

namespace topo::exploration {
namespace {

std::string metres(double value) {
  std::array<char, 24> text{};
  const int n = std::snprintf(text.data(), text.size(), "%.1f m", value);
  return {text.data(), std::min(static_cast<std::size_t>(std::max(n, 0)), text.size() - 1)};
}

std::string description(const goals::Goal& goal, Source source) {
  if (source == Source::kDoubt) return "a place that is looked at again";
  std::string text;
  if (goal.side != goals::Side::kNone) text = std::string(goals::to_text(goal.side)) + " side of ";
  text += goal.place != 0 ? "place " + std::to_string(goal.place) : "frontier";
  return text + ", opening " + metres(goal.opening_m);
}

bool is_viewpoint(const Pursuit& pursuit) { return pursuit.id.source == Source::kViewpoint; }

bool is_doubted(const Pursuit& pursuit) { return pursuit.id.source == Source::kDoubt; }

/// Giving up a viewpoint does not defer a goal beside it.
Intent give_up(const Situation& situation, const PursuitParams& params, std::string why, Intent intent) {
  const types::Vector2 p_map = intent.pursuit.goal->p_map;
  intent.log.note(situation.now, p_map, "given up: " + why);
  if (is_doubted(intent.pursuit))
    intent.sweep.looked_again.push_back(p_map);
  else if (!is_viewpoint(intent.pursuit) || !intent.sweep.sweep.leave(intent.pursuit.id.number))
    intent.deferred.give_up(p_map, situation.now + types::from_seconds(params.give_up_s), std::move(why));
  intent.pursuit = without_goal(std::move(intent.pursuit));
  return intent;
}

/// A stuck robot finds goals and loses them again without moving. They do not lead on, and the exploration
/// resumes once the robot is free, so they do not count as resumptions.
Intent give_up_stuck(const Situation& situation, const travel::RouteMap& map, const ExplorationParams& params,
                     std::string why, Intent intent) {
  intent = block_ahead(situation, map, params.pursuit, std::move(intent));
  Attempts& attempts = intent.attempts;
  if (attempts.resumed > 0 && attempts.stuck < params.ending.stuck_max) {
    --attempts.resumed;
    ++attempts.stuck;
  }
  return give_up(situation, params.pursuit, std::move(why), std::move(intent));
}

/// What is still open after a visit is not visible from there. The final sweep finds other viewpoints for it;
/// without a sweep only a second visit is left.
Intent reach(const Situation& situation, const ExplorationParams& params, Intent intent) {
  const types::Vector2 p_map = intent.pursuit.goal->p_map;
  if (is_doubted(intent.pursuit)) {
    intent.sweep.looked_again.push_back(p_map);
  } else if (!is_viewpoint(intent.pursuit) || !intent.sweep.sweep.arrive(intent.pursuit.id.number)) {
    const types::Stamp again = situation.now + types::from_seconds(params.pursuit.visited_s);
    const bool comes_back = params.finish == Finish::kEssential || !row_of(params.strategy).tours;
    intent.deferred.visit(p_map, comes_back ? std::optional(again) : std::nullopt);
  }
  intent.attempts.recalled = 0;
  intent.log.note(situation.now, p_map, "reached");
  intent.pursuit = without_goal(std::move(intent.pursuit));
  return intent;
}

constexpr const char* kTurns = "turns on the spot: what lies behind is unknown";

/// A goal counts as visited by nearness, and a robot that begins with its back to all there is has none:
/// before it ends, it turns once to what is unknown behind it.
std::optional<double> due_turn(const Situation& situation, const travel::RouteMap& map,
                               const LookBehindParams& params, const Attempts& attempts) {
  const auto& last = attempts.turned_at;
  if (last && (*last - situation.here()).norm() <= params.again_m) return std::nullopt;
  return heading_to_unseen(map.map(), situation.T_map_base, params);
}

Intent turn_to(double heading_rad, const Situation& situation, Intent intent) {
  intent.log.note(situation.now, situation.here(), kTurns);
  intent.attempts.turned_at = situation.here();
  intent.pursuit = turning_to(heading_rad, std::move(intent.pursuit), situation.now);
  return intent;
}

/// The intent after the present goal was reached, given up, or neither.
Intent settle(const Situation& situation, const travel::RouteMap& map, const ExplorationParams& params,
              Intent intent) {
  if (!intent.pursuit.goal && !intent.pursuit.turn_to_rad) return intent;
  intent.pursuit = with_progress(std::move(intent.pursuit), situation.here(), situation.now, params.pursuit);
  const Pursuit& pursuit = intent.pursuit;
  const bool looks = is_viewpoint(pursuit) && intent.sweep.sweep.has(pursuit.id.number);
  const double reached_m = looks ? intent.sweep.sweep.reached_m() : params.pursuit.goal_reached_m;
  const Settled outcome =
      settled(pursuit, situation.feedback, situation.here(), map.map().centre_of(pursuit.target), reached_m,
              situation.now, params.pursuit);
  if (pursuit.turn_to_rad) {  // one that is not possible ends like one that was made
    if (outcome != Settled::kUnderWay) intent.pursuit = without_goal(std::move(intent.pursuit));
    return intent;
  }
  switch (outcome) {
    case Settled::kUnderWay:
      return intent;
    case Settled::kReached:
      return reach(situation, params, std::move(intent));
    case Settled::kStuck:
      return give_up_stuck(situation, map, params, "stuck on the way", std::move(intent));
    case Settled::kNoProgress:
      return give_up_stuck(situation, map, params, "no progress", std::move(intent));
    case Settled::kTooLong:
      return give_up(situation, params.pursuit, "not reached in four minutes", std::move(intent));
  }
  return intent;
}

Intent wait_for_goal(const Situation& situation, std::string why, Intent intent) {
  if (intent.pursuit.goal) intent.log.note(situation.now, intent.pursuit.goal->p_map, "left to another");
  intent.pursuit = without_goal(std::move(intent.pursuit));
  intent.pursuit.has_target = false;
  intent.pursuit.last_progress = situation.now;
  intent.reason = std::move(why);
  return intent;
}

/// The turn goes on; nothing else is decided meanwhile.
Intent keep_turning(Intent intent) {
  intent.pursuit.has_target = false;
  intent.reason = kTurns;
  return intent;
}

/// No goal is in reach. The exploration does not end at once: a person may stand in a doorway.
Intent run_dry(const Situation& situation, Searches searches, const ExplorationParams& params, bool cut_off,
               Intent intent) {
  intent.pursuit.has_target = false;
  if (const auto heading_rad = due_turn(situation, searches.map, params.look_behind, intent.attempts))
    return keep_turning(turn_to(*heading_rad, situation, std::move(intent)));
  types::Stamp& since = intent.attempts.nothing_since;
  if (since == types::Stamp{}) since = situation.now;
  const bool is_patient = situation.now - since < params.ending.patience;
  if (cut_off && intent.obstacles.forget(situation.now)) {
    intent.reason = "no way to the goals left: what no laser sees is forgotten";
  } else if (cut_off && is_patient) {
    intent.reason = "no way to the goals left just now";
  } else if (cut_off && !intent.sweep.meanwhile && has_final_sweep(params)) {
    intent.sweep.meanwhile = true;
    intent.reason = "no way to the goals left: looks into corners meanwhile";
  } else if (situation.analysis.revision != searches.map.revision()) {
    intent.reason = "waits for the analysis of the newest map";
  } else if (intent.attempts.recalled < params.ending.recalls_max &&
             intent.deferred.call_back(situation.now)) {
    ++intent.attempts.recalled;
    intent.reason = "only goals given up before are left: they are tried again";
  } else if (situation.team.has_mates() && params.ending.stays_out &&
             mates_have_goals(situation.team.roster, situation.now)) {
    return wait_for_goal(situation, "waits: no goal is in reach, but others have some", std::move(intent));
  } else {
    intent = note_what_remains(situation, searches.map, params, std::move(intent));
    // Of a complete exploration the looks that are left out are no goals: the log has them.
    const std::size_t goals_out = params.finish == Finish::kWorth ? intent.outlook.left_out.size() : 0;
    intent.phase = next(std::move(intent.phase), event::GoalsExhausted{goals_out});
    intent.log.note(situation.now, situation.start, std::get<Returning>(intent.phase).why);
    return go_home(situation, searches, params, std::move(intent));
  }
  return intent;
}

/// True when a candidate justifies turning round on the way home, and this robot would get it.
bool is_worth_resuming(const Alternatives& among, const Situation& situation, Searches searches,
                       const ExplorationParams& params, const Attempts& attempts) {
  const bool is_wide = std::any_of(among.candidates.begin(), among.candidates.end(), [&](const Candidate& c) {
    return c.goal.opening_m >= params.ending.resume_for_m;
  });
  return is_wide && attempts.resumed != params.ending.resumes_max &&
         choose(among, situation, searches.map, params).best != nullptr;
}

/// The candidate that is chosen, and why.
struct Decided {
  Choice choice;
  bool is_present = false;  ///< it succeeds the present goal
  bool is_first = false;    ///< it is in an area that comes first
};

/// Among the goals of areas that come first, as long as there are such and mates have not all of them.
Decided decided(const Judged& all, const Judged& first, const Situation& situation, Searches searches,
                const ExplorationParams& params, const Intent& intent) {
  for (const Judged* among : {&first, &all}) {
    if (among == &first && first.candidates.empty()) continue;
    const Candidate* present = intent.pursuit.goal ? successor_of(*intent.pursuit.goal, among->candidates,
                                                                  params.candidate.successor_m)
                                                   : nullptr;
    Choice choice = choose({among->candidates, among->table, present, intent.offer.claimed_m}, situation,
                           searches.map, params);
    if (choice.best == nullptr && among == &first) continue;
    const bool is_present = choice.best != nullptr && choice.best == present;
    return {std::move(choice), is_present, among == &first};
  }
  return {};
}

/// Takes the chosen candidate as the goal: the successor of the present one, which recedes as the map grows,
/// or another.
Intent take(const Situation& situation, const ExplorationParams& params, const Decided& decided,
            Intent intent) {
  const Candidate& best = *decided.choice.best;
  const std::string why =
      description(best.goal, best.id.source) + (decided.is_first ? ", in an area that comes first" : "");
  Pursuit& pursuit = intent.pursuit;
  if (decided.is_present) {
    pursuit.goal = best.goal;
    pursuit.id = best.id.number != 0 ? best.id : GoalId{best.id.source, pursuit.number};
  } else {
    if (pursuit.goal) {
      intent.log.note(situation.now, pursuit.goal->p_map,
                      decided.is_first ? "left for one that comes first" : "left for a nearer one");
    }
    const GoalId id = best.id.number != 0 ? best.id : GoalId{best.id.source, pursuit.number + 1};
    pursuit = set_out(std::move(pursuit), best.goal, id, situation.now, situation.here());
    intent.offer.claimed_m = weighed_cost_m(best, &best, params.switch_gain);
    ++intent.log.goals_issued;
    intent.log.note(situation.now, best.goal.p_map, "taken: " + why + ", " + metres(best.cost_m) + " to go");
  }
  pursuit.target = best.cell;
  pursuit.has_target = true;
  intent.reason = why;
  return intent;
}

}  // namespace

Intent explore(const Situation& situation, Searches searches, const ExplorationParams& params,
               Intent intent) {
  const bool homing = is_homing(intent.phase);
  if (!homing) {
    intent = keep_contact(situation, searches, params, std::move(intent));
    if (std::holds_alternative<SeekingContact>(intent.phase)) return intent;
    intent = settle(situation, searches.map, params, std::move(intent));
    if (intent.pursuit.turn_to_rad) return keep_turning(std::move(intent));
  }
  Proposal proposal = propose(situation, searches, params, homing, intent.deferred, std::move(intent.sweep));
  intent.sweep = std::move(proposal.sweep);
  const auto successor = [&](const std::vector<Candidate>& among) -> const Candidate* {
    return intent.pursuit.goal ? successor_of(*intent.pursuit.goal, among, params.candidate.successor_m)
                               : nullptr;
  };
  const auto judge = [&](std::vector<Candidate> some) {
    const Candidate* const pursued = successor(some);
    return judged(std::move(some), pursued, situation, searches, params);
  };
  Judged all = judge(std::move(proposal.candidates));
  if (all.candidates.empty() && !homing) {
    Judged looks = judge(propose_looks(situation, searches, params, intent.pursuit, intent.sweep));
    looks.left_out = std::move(all.left_out);
    all = std::move(looks);
  }
  const std::vector<Candidate>& candidates = all.candidates;
  intent.outlook = {{}, all.left_out, proposal.only_gaps, proposal.clusters};
  for (const Candidate& c : candidates) intent.outlook.open_goals.push_back(c.goal);
  if (homing) {
    if (!is_worth_resuming({candidates, all.table, nullptr, 0.0}, situation, searches, params,
                           intent.attempts))
      return go_home(situation, searches, params, std::move(intent));
    ++intent.attempts.resumed;
    intent.phase = next(std::move(intent.phase), event::GoalFound{});
    intent.pursuit = without_goal(std::move(intent.pursuit));
  }
  const Judged first = here_first(all, situation.here_first);
  Decided chosen = decided(all, first, situation, searches, params, intent);
  intent.offer.bids = std::move(chosen.choice.bids);
  if (intent.pursuit.goal && successor(candidates) == nullptr) {
    const types::Vector2 p_map = intent.pursuit.goal->p_map;
    intent.log.note(situation.now, p_map, "dropped: seen, or no longer a goal");
    if (!candidates.empty())
      intent.deferred.vanish(p_map, situation.now + types::from_seconds(params.pursuit.give_up_s));
    intent.pursuit = without_goal(std::move(intent.pursuit));
  }
  if (chosen.choice.best == nullptr && candidates.empty())
    return run_dry(situation, searches, params, proposal.cut_off, std::move(intent));
  intent.attempts.nothing_since = {};
  if (chosen.choice.best == nullptr)
    return wait_for_goal(situation, "waits: others are nearer to every goal", std::move(intent));
  ++intent.log.decisions_made;
  intent.log.clusters_sum += static_cast<std::uint64_t>(proposal.clusters);
  intent.log.goals_sum += candidates.size();
  return take(situation, params, chosen, std::move(intent));
}

}  // namespace topo::exploration
