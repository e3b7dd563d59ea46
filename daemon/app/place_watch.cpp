// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/app/place_watch.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <utility>

namespace topo::daemon {

using slam::TrialVerdict;
using types::PlaceStanding;

namespace {

std::string_view verdict_text(TrialVerdict verdict) {
  switch (verdict) {
    case TrialVerdict::kNone:
      return "none";
    case TrialVerdict::kRunning:
      return "running";
    case TrialVerdict::kPassed:
      return "passed";
    case TrialVerdict::kDropped:
      return "dropped";
  }
  return "unknown";
}

std::string trial_text(const slam::TrialCount& trial) {
  return fmt::format("after {:.1f} m {} scans match the older map, {} contradict it, {} say nothing",
                     trial.way_m, trial.matched, trial.contradicted, trial.silent);
}

}  // namespace

std::string_view to_text(PlaceStanding standing) {
  switch (standing) {
    case PlaceStanding::kKnown:
      return "known";
    case PlaceStanding::kUnknown:
      return "unknown";
    case PlaceStanding::kProposed:
      return "proposed";
    case PlaceStanding::kDropped:
      return "dropped";
  }
  return "unknown";
}

void PlaceWatch::stand(PlaceStanding standing) {
  known_from_.reset();
  hand_overs_.place.standing.store(standing, std::memory_order_release);
}

PlaceStanding PlaceWatch::standing() const { return hand_overs_.place.now(); }

void PlaceWatch::seek(std::string why, bool is_trouble, std::optional<PlaceOffer> offer) {
  if (is_trouble && why != obstacle_) spdlog::warn("session: {}", why);  // an attempt may be repeated
  obstacle_ = std::move(why);
  is_trouble_ = is_trouble;
  offer_ = std::move(offer);
  stand(PlaceStanding::kUnknown);
  hand_overs_.journal.held.store(true, std::memory_order_release);
}

void PlaceWatch::propose(PlaceOffer offer, const std::string& place) {
  obstacle_ = fmt::format(
      "where the robot is in session {} is a proposal: {} (topoctl session confirm when that is right, "
      "topoctl session confirm --pose X Y THETA where it is elsewhere, or topoctl session new)",
      offer.name, place);
  is_trouble_ = true;
  spdlog::warn("session: {}", obstacle_);
  offer_ = std::move(offer);
  stand(PlaceStanding::kProposed);
}

void PlaceWatch::take(PlaceOffer session, std::uint64_t map, types::Stamp now) {
  obstacle_.clear();
  is_trouble_ = false;
  offer_ = std::move(session);
  trial_map_ = map;
  trial_ = {};
  known_from_ = now + kPlanAge;
}

void PlaceWatch::own() {
  obstacle_.clear();
  is_trouble_ = wants_fresh_map_ = anew_ = dropped_before_ = false;
  offer_.reset();
  trial_map_ = 0;
  stand(PlaceStanding::kKnown);
  hand_overs_.journal.held.store(false, std::memory_order_release);
  hand_overs_.journal.wakeup.post();
}

void PlaceWatch::begin_anew() {
  seek("a new map is being begun", false);
  wants_fresh_map_ = anew_ = true;
}

void PlaceWatch::fresh_map_made() {
  wants_fresh_map_ = false;
  if (anew_) own();
}

void PlaceWatch::drop() {
  const std::string name = offer_ ? offer_->name : std::string();
  obstacle_ = fmt::format(
      "the place in session {} was dropped, the robot's place is not known: {}; what was mapped since is "
      "left out of it (topoctl session confirm --pose X Y THETA says where the robot is, topoctl session "
      "load {} looks for it again, topoctl session new begins a new map here)",
      name, trial_text(trial_), name);
  spdlog::warn("session: {}", obstacle_);
  is_trouble_ = wants_fresh_map_ = dropped_before_ = true;
  if (offer_) offer_->T_map_base.reset();
  trial_map_ = 0;
  stand(PlaceStanding::kDropped);
}

bool PlaceWatch::note(const MappingReport& report, types::Stamp now) {
  if (known_from_ && now >= *known_from_) stand(PlaceStanding::kKnown);
  if (!on_trial() || is_trouble_ || report.map < trial_map_) return false;
  trial_ = report.trial;
  if (trial_.verdict == TrialVerdict::kDropped) return drop(), true;
  if (trial_.verdict != TrialVerdict::kPassed) return false;
  spdlog::info("session: the first metres match: {}", trial_text(trial_));
  trial_map_ = 0;
  offer_.reset();
  hand_overs_.journal.held.store(false, std::memory_order_release);
  hand_overs_.journal.wakeup.post();
  return false;
}

Json PlaceWatch::json() const {
  Json json{{"standing", to_text(standing())},
            {"session", offer_ ? offer_->name : std::string()},
            {"waits", waiting().has_value()},
            {"on_trial", on_trial()},
            {"trial",
             {{"verdict", verdict_text(trial_.verdict)},
              {"way_m", trial_.way_m},
              {"matched", trial_.matched},
              {"contradicted", trial_.contradicted},
              {"silent", trial_.silent}}},
            {"proposed", nullptr}};
  if (offer_ && offer_->T_map_base && is_trouble_) {
    const types::Se2& pose = *offer_->T_map_base;
    json["proposed"] = {{"x_m", pose.x_m}, {"y_m", pose.y_m}, {"theta_rad", pose.theta_rad}};
  }
  return json;
}

}  // namespace topo::daemon
