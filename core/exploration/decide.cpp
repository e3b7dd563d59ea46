// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <utility>

#include "core/exploration/intent.hpp"
#include "core/exploration/params.hpp"

namespace topo::exploration {
namespace {

/// With a low battery the robot gives up its goal and returns.
Intent heed_battery(const Situation& situation, Intent intent) {
  if (!situation.battery_low) return intent;
  const bool was_homing = is_homing(intent.phase);
  intent.phase = next(std::move(intent.phase), event::BatteryLow{});
  if (was_homing || !is_homing(intent.phase)) return intent;
  intent.pursuit = without_goal(std::move(intent.pursuit));
  intent.log.note(situation.now, situation.start, "home: the battery is low");
  return intent;
}

}  // namespace

Intent begin_mission(Intent intent, Order order, types::Stamp now) {
  intent.phase = next(std::move(intent.phase), event::Ordered{order});
  intent.reason = order == Order::kStand ? "standing, as told" : "";
  intent.pursuit = without_goal(std::move(intent.pursuit));
  intent.pursuit.has_target = false;
  intent.attempts = {};
  intent.deferred.clear();
  intent.sweep.sweep.begin(now);
  intent.sweep.meanwhile = false;
  intent.sweep.looked_again.clear();
  intent.offer.bids.clear();
  intent.offer.home.reset();
  intent.offer.ignore_passing_until = {};
  intent.contact.forget();
  intent.obstacles.open_passages();
  intent.outlook.open_goals.clear();
  intent.outlook.only_gaps = false;
  if (order == Order::kExplore) intent.log = {};
  return intent;
}

Intent held_up(Intent intent, types::Duration elapsed) {
  intent.pursuit.taken += elapsed;
  intent.pursuit.last_progress += elapsed;
  if (intent.attempts.nothing_since != types::Stamp{}) intent.attempts.nothing_since += elapsed;
  intent.sweep.sweep.wait(elapsed);
  return intent;
}

Intent moved(Intent intent, const types::MapCorrection& correction) {
  intent.deferred.move(correction);
  intent.obstacles.move(correction);
  intent.contact.move(correction);
  intent.sweep.sweep.move(correction);
  correction.move(intent.sweep.looked_again);
  for (std::optional<types::Vector2>* at : {&intent.attempts.turned_at, &intent.attempts.looked_from})
    if (*at) *at = correction(**at);
  return intent;
}

Intent decide(const Situation& situation, Searches searches, const ExplorationParams& params, Intent intent) {
  if (!is_homing(intent.phase)) intent.offer.home.reset();
  intent.phase = next(std::move(intent.phase), event::Rechecked{});
  intent = give_way(situation, searches, params, std::move(intent));
  if (std::holds_alternative<MakingWay>(intent.phase)) return intent;
  intent = heed_battery(situation, std::move(intent));
  if (std::holds_alternative<GoingTo>(intent.phase))
    return go_to_target(situation, searches, params, std::move(intent));
  if (!is_homing(intent.phase)) return explore(situation, searches, params, std::move(intent));
  // An exploration on its way home resumes when an opening is found, unless the battery is low.
  const bool may_resume = situation.mission.order == Order::kExplore && !situation.battery_low;
  return may_resume ? explore(situation, searches, params, std::move(intent))
                    : go_home(situation, searches, params, std::move(intent));
}

}  // namespace topo::exploration
