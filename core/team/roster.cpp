// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/team/roster.hpp"

#include <algorithm>

#include "core/team/homes.hpp"

namespace topo::team {
namespace {

/// Such a robot moves up for one that needs to pass (homes.hpp).
bool waits_at_home(const StatusMessage& message, double at_start_m) {
  return message.duty == Duty::kOver && message.home &&
         is_at_home(message, {message.robot, *message.home}, at_start_m);
}

}  // namespace

bool Roster::take(const StatusMessage& message, types::Stamp now) {
  const auto [at, added] = mates_.try_emplace(message.robot);
  Mate& mate = at->second;
  const bool anew = added || (is_silent(mate, now) && message.sequence != mate.message.sequence);
  if (!anew && message.sequence <= mate.message.sequence) return false;
  const types::Vector2 here = message.T_map_base.translation();
  if (anew || message.duty != Duty::kUnable) mate.able_at = now;
  if (anew || !message.claim || (here - mate.stood).norm() > params_.progress_m) {
    mate.progress_at = now;
    mate.stood = here;
  }
  mate.message = message;
  mate.heard = now;
  return true;
}

bool Roster::is_silent(const Mate& mate, types::Stamp now) const {
  return now - mate.heard > types::from_seconds(params_.silent_s);
}

std::vector<const StatusMessage*> Roster::heard_within(types::Stamp now, double within_s) const {
  std::vector<const StatusMessage*> messages;
  for (const auto& [id, mate] : mates_) {
    if (now - mate.heard <= types::from_seconds(within_s)) messages.push_back(&mate.message);
  }
  return messages;
}

std::vector<const StatusMessage*> Roster::heard(types::Stamp now) const {
  return heard_within(now, params_.silent_s);
}

std::vector<const StatusMessage*> Roster::not_missing(types::Stamp now) const {
  return heard_within(now, params_.missing_s);
}

bool Roster::counts(const Mate& mate, types::Stamp now) const {
  const bool unable = now - mate.able_at > types::from_seconds(params_.unable_s);
  const bool stuck = now - mate.progress_at > types::from_seconds(params_.stuck_s);
  return !is_silent(mate, now) && mate.message.duty != Duty::kOver && !unable && !stuck;
}

std::vector<const StatusMessage*> Roster::counted(types::Stamp now) const {
  std::vector<const StatusMessage*> messages;
  for (const auto& [id, mate] : mates_) {
    if (counts(mate, now)) messages.push_back(&mate.message);
  }
  return messages;
}

std::vector<types::Vector2> Roster::going_at(types::Stamp now) const {
  std::vector<types::Vector2> places;
  for (const auto& [id, mate] : mates_) {
    const bool goes = counts(mate, now) && mate.message.duty == Duty::kAble;
    if ((goes || waits_at_home(mate.message, params_.at_start_m)) &&
        now - mate.heard <= params_.place_age_max)
      places.push_back(mate.message.T_map_base.translation());
  }
  return places;
}

bool Roster::any_at_work() const {
  return std::any_of(mates_.begin(), mates_.end(),
                     [](const auto& entry) { return entry.second.message.duty != Duty::kOver; });
}

bool Roster::all_home(types::Stamp now) const {
  return std::all_of(mates_.begin(), mates_.end(), [&](const auto& entry) {
    const Mate& mate = entry.second;
    return mate.message.duty == Duty::kOver || now - mate.heard > types::from_seconds(params_.missing_s);
  });
}

}  // namespace topo::team
