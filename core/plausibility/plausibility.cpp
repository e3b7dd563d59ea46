// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/plausibility/plausibility.hpp"

#include <algorithm>
#include <cmath>

#include "core/plausibility/motion_check.hpp"

namespace topo::plausibility {
namespace {

constexpr std::size_t at(Doubt doubt) { return static_cast<std::size_t>(doubt); }

bool stands(const types::BaseState* base, const StandingParams& params) {
  return base == nullptr || (std::abs(base->odometry.twist.v_mps) < params.v_mps &&
                             std::abs(base->odometry.twist.omega_radps) < params.omega_radps);
}

}  // namespace

Plausibility::Plausibility(const PlausibilityParams& params, bool disobeyed)
    : params_(params),
      commands_(params.commands),
      obedience_(params.obedience),
      match_(params.match),
      motors_(params.motors),
      picture_(params.picture),
      braking_(params.braking) {
  held_[at(Doubt::kDisobeys)].latched = disobeyed;
}

void Plausibility::judge_status(const Evidence& evidence) {
  const types::BaseState& base = *evidence.base;
  if (base.arrival == last_status_) return;
  const bool anew = last_status_ != types::Stamp{} && base.arrival - last_status_ > params_.standing.silence;
  if (anew) {
    obedience_.reset();
    obeys_ = {};
  }
  const bool first = anew || last_status_ == types::Stamp{};
  last_status_ = heard_ = base.arrival;
  switched_off_ = motors_.judge(base, first);
  impossible_ =
      is_impossible(first ? nullptr : &last_odometry_, base.odometry, evidence.model, params_.motion);
  last_odometry_ = base.odometry;
  if (impossible_) return;  // of what is not measured nothing else is concluded
  obeys_ = obedience_.judge(commands_, base, evidence.limits);
  braking_.judge(commands_, base, evidence.limits.deceleration_mps2);
}

DoubtSet Plausibility::causes(const Evidence& evidence) {
  DoubtSet now;
  // Motors that are off follow no command.
  const bool driven = evidence.base != nullptr && evidence.base->motors_enabled;
  commands_.add(evidence.now, driven ? evidence.commanded : types::Twist2{}, evidence.limits);
  motors_.want(evidence.now, evidence.motors_wanted);
  if (evidence.base != nullptr) {
    judge_status(evidence);
    now.set(at(Doubt::kMotorsOff), switched_off_);
    now.set(at(Doubt::kDisobeys), obeys_.disobeys);
    now.set(at(Doubt::kAnswersLate), obeys_.late || evidence.base->round_trip > params_.round_trip_max);
    now.set(at(Doubt::kImpossibleMotion), impossible_);
    now.set(at(Doubt::kLateStatuses), evidence.base->late > params_.late_max);
  }
  if (evidence.front != nullptr) {
    if (evidence.front->arrival != last_scan_) {
      last_scan_ = evidence.front->arrival;
      sees_ = picture_.judge(*evidence.front, evidence.T_base_laser);
    }
    now.set(at(Doubt::kLateScans), evidence.front->late > params_.late_max);
    now.set(at(Doubt::kBlind), sees_.blind);
    now.set(at(Doubt::kFailed), sees_.failed);
    now.set(at(Doubt::kFrozen), sees_.frozen);
    now.set(at(Doubt::kCovered), sees_.covered);
  }
  if (evidence.matched != nullptr && evidence.matched->stamp != last_match_) {
    last_match_ = evidence.matched->stamp;
    match_.judge(*evidence.matched);
  }
  now.set(at(Doubt::kMatchDisagrees), match_.disagrees());
  return now;
}

void Plausibility::hold(std::size_t doubt, bool cause, bool standing, const Evidence& evidence) {
  Held& held = held_[doubt];
  const bool disobeys = doubt == at(Doubt::kDisobeys);
  if (cause && !present_.test(doubt)) {
    if (held.strikes == 0 || evidence.now - held.first > params_.strikes_in) {
      held.first = evidence.now;
      held.strikes = 0;
    }
    held.latched = disobeys || doubt == at(Doubt::kMotorsOff) || ++held.strikes >= params_.strikes;
  }
  if (cause) held.until = evidence.now + params_.hold;
  const bool motors_off = evidence.base != nullptr && !evidence.base->motors_enabled;
  const bool cleared = evidence.cleared && (disobeys ? rests(evidence) : standing);
  if (cleared || (disobeys && motors_off)) held = Held{held.until, {}, 0, false};
  const bool lasts = held.until != types::Stamp{} && (evidence.now < held.until || !standing);
  present_.set(doubt, cause || held.latched || (present_.test(doubt) && lasts));
}

/// True when a base that does not obey stands, as far as can be known.
bool Plausibility::rests(const Evidence& evidence) const {
  if (evidence.base != nullptr) return stands(evidence.base, params_.standing);
  return evidence.now - heard_ >= params_.unheard_stands;
}

/// At once and without the hold: a driver that waits for it hears of a reset once.
void Plausibility::release() {
  obedience_.reset();
  obeys_ = {};
  held_[at(Doubt::kDisobeys)] = {};
  present_.reset(at(Doubt::kDisobeys));
}

Opinion Plausibility::judge(const Evidence& evidence) {
  if (heard_ == types::Stamp{}) heard_ = evidence.now;
  if (evidence.base_released) release();
  const DoubtSet now = causes(evidence);
  const bool standing = stands(evidence.base, params_.standing);
  for (std::size_t doubt = 0; doubt < kDoubts; ++doubt) hold(doubt, now.test(doubt), standing, evidence);
  if (evidence.cleared && standing) obedience_.reset();
  if (present_.test(at(Doubt::kAnswersLate)) && !now.test(at(Doubt::kAnswersLate))) obedience_.measure_anew();
  Opinion opinion;
  opinion.doubts = present_;
  opinion.lag = obeys_.lag;
  if (evidence.front != nullptr) opinion.scan_late = evidence.front->late;
  if (evidence.base != nullptr) opinion.status_late = evidence.base->late;
  opinion.deceleration_mps2 = braking_.measured_mps2();
  return opinion;
}

}  // namespace topo::plausibility
