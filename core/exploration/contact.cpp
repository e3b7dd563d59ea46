// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

// A robot that has not heard any team-mate for long returns to the place of last contact, then continues.
#include <utility>

#include "core/exploration/intent.hpp"
#include "core/exploration/stuck.hpp"

namespace topo::exploration {
namespace {

Intent end(const Situation& situation, std::string how, Intent intent) {
  intent.log.note(situation.now, situation.here(), std::move(how));
  intent.contact.put_off(situation.now);
  intent.phase = next(std::move(intent.phase), event::ContactEnded{});
  intent.pursuit = without_goal(std::move(intent.pursuit));
  intent.pursuit.has_target = false;
  ++intent.pursuit.number;
  return intent;
}

}  // namespace

Intent keep_contact(const Situation& situation, Searches searches, const ExplorationParams& params,
                    Intent intent) {
  const std::optional<types::Vector2> place = intent.contact.lost_at(situation.now);
  const bool seeks = std::holds_alternative<SeekingContact>(intent.phase);
  if (!place) return seeks ? end(situation, "in contact again: on", std::move(intent)) : intent;
  if (!seeks) {
    intent.phase = next(std::move(intent.phase), event::ContactLost{});
    intent.log.note(situation.now, *place, "out of contact for long: back to where another was last heard");
    intent.pursuit = without_goal(std::move(intent.pursuit));  // control's report refers to another route
  }
  const bool about_this = situation.is_about(intent.pursuit) && intent.pursuit.goal;
  const bool arrived = about_this && situation.feedback.arrived;
  if (arrived || (*place - situation.here()).norm() <= params.pursuit.goal_reached_m)
    return end(situation, "nobody is heard where one was: on", std::move(intent));
  const bool stuck = about_this && situation.feedback.stuck;
  if (stuck) intent = block_ahead(situation, searches.map, params.pursuit, std::move(intent));
  if (!intent.pursuit.goal) {
    goals::Goal back;
    back.p_map = *place;
    intent.pursuit = set_out(std::move(intent.pursuit), back, {}, situation.now, situation.here());
  }
  intent.pursuit = with_progress(std::move(intent.pursuit), situation.here(), situation.now, params.pursuit);
  const bool stands = situation.now - intent.pursuit.last_progress > params.pursuit.standstill;
  const char* const kNoWay = "no way to where another was last heard: on";
  if (stuck || stands) return end(situation, kNoWay, std::move(intent));
  intent.pursuit = aimed_at(*place, searches.map, std::move(intent.pursuit));
  if (!intent.pursuit.has_target) return end(situation, kNoWay, std::move(intent));
  intent.reason = "goes back to where another was last heard";
  return intent;
}

}  // namespace topo::exploration
