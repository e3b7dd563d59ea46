// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/pipeline/control_senses.hpp"

#include <cmath>
#include <utility>

#include "core/perception/stop_zone.hpp"
#include "core/perception/unseen_echoes.hpp"
#include "core/types/invariant.hpp"

namespace topo::pipeline {
namespace {

using types::Se2;

/// True when the base's newest state is present and finite.
bool has_state(const ControlInput& in) { return in.state != nullptr && motion::is_finite(*in.state); }

}  // namespace

ControlSenses::ControlSenses(const perception::PerceptionParams& perception,
                             const motion::MotionParams& motion)
    : stop_zone_(perception.stop_zone),
      gate_(motion.gate),
      steady_frame_(perception.steady_frame),
      breadcrumbs_(motion.breadcrumbs),
      blind_spot_(perception.blind_spot),
      tracker_(perception.moving) {}

motion::GateInput ControlSenses::perceive(const ControlSetup& setup, const ControlInput& in) {
  motion::GateInput g;
  g.T_map_base = place_by_plan(setup, in);
  follow_drift(g.T_map_base, in);
  g.place = in.place;
  if (in.place != types::PlaceStanding::kKnown) g.T_map_base.reset();  // area limits are of another map
  drive_on(in);
  g.now = in.now;
  g.request.stamp = in.now;
  g.base = in.state;
  g.front_scan = in.front;
  g.T_base_laser = setup.T_base_laser;
  g.moving = moving(setup, in);
  g.front_points = points(setup, in, g.moving);
  if (in.front != nullptr) own_echo_.update(*in.front, setup.T_base_laser, setup.limits.footprint);
  g.T_base_sonar = in.T_base_sonar;
  g.estop_pressed = in.estop;
  g.estop_cleared = in.estop_cleared;
  g.firmware_watchdog = in.firmware_watchdog;
  g.limits = setup.limits;
  g.area = in.area != nullptr ? in.area : &setup.area;
  g.params = gate_;
  g.stop_zone = stop_zone_;
  return g;
}

std::optional<Se2> place_by_plan(const ControlSetup& setup, const ControlInput& in) {
  if (in.plan == nullptr || !in.plan->located || in.state == nullptr) return std::nullopt;
  if (motion::is_stale(in.plan->stamp, in.now, setup.plan_age_max)) return std::nullopt;
  return in.plan->T_map_odom.se2() * perception::pose_at(in.state->odometry, in.now);
}

/// Runs once for every plan.
void ControlSenses::follow_drift(const std::optional<Se2>& T_map_base, const ControlInput& in) {
  if (!has_state(in)) return;
  if (!T_map_base) return steady_frame_.lose();
  if (in.plan->sequence == std::exchange(steady_plan_, in.plan->sequence)) return;
  steady_frame_.update(in.plan->T_map_odom, in.plan->bends, in.state->odometry);
}

/// Adds every dead reckoning to the breadcrumb path once.
void ControlSenses::drive_on(const ControlInput& in) {
  if (!has_state(in) || in.state->odometry.stamp == breadcrumbs_stamp_) return;
  breadcrumbs_stamp_ = in.state->odometry.stamp;
  breadcrumbs_.update(steady_frame_.steady(in.state->odometry).T_odom_base.se2());
}

std::span<const perception::MovingObstacle> ControlSenses::moving(const ControlSetup& setup,
                                                                  const ControlInput& in) {
  if (in.front == nullptr || !has_state(in)) return {};
  tracker_.update(*in.front, setup.T_base_laser, in.state->odometry);
  return {moving_.data(), tracker_.around(in.state->odometry, in.front->first_beam, moving_)};
}

std::span<const perception::ScanPoint> ControlSenses::points(
    const ControlSetup& setup, const ControlInput& in,
    std::span<const perception::MovingObstacle> moving_now) {
  if (in.front == nullptr) return {};
  constexpr std::size_t kSeen = perception::BlindSpot::kMax;
  const std::span<perception::ScanPoint> all(points_);
  const std::size_t seen =
      perception::scan_points(*in.front, setup.T_base_laser, stop_zone_, all.subspan(kSeen));
  if (!has_state(in)) return all.subspan(kSeen, seen);
  const types::Odometry odometry = steady_frame_.steady(in.state->odometry);
  blind_spot_.update(*in.front, setup.T_base_laser, all.subspan(kSeen, seen), moving_now,
                     setup.limits.footprint, odometry);
  const std::size_t kept = blind_spot_.size();
  types::require(kept <= kSeen, "pipeline::ControlSenses: more points kept than there is room for");
  blind_spot_.put_points(perception::pose_at(odometry, in.front->first_beam),
                         all.subspan(kSeen - kept, kept));
  return all.subspan(kSeen - kept, kept + seen);
}

double ControlSenses::seen_behind_m(const motion::GateInput& gate_in, double most_m) const {
  const Se2 T_odom_base = perception::pose_at(steady_frame_.steady(gate_in.base->odometry), gate_in.now);
  return blind_spot_.seen_behind_m(T_odom_base, gate_in.limits.footprint, gate_in.now, most_m);
}

void report_unseen(const motion::GateInput& gate_in, const perception::UnseenEchoParams& params,
                   ControlReport& report) {
  if (std::abs(gate_in.base->odometry.twist.omega_radps) > params.steady_radps) return;
  const std::size_t count =
      perception::unseen_echoes(motion::surroundings(gate_in), params, report.unseen_odom);
  for (std::size_t i = 0; i < count; ++i)
    report.unseen_odom[i] = report.odometry.T_odom_base.se2() * report.unseen_odom[i];
  report.unseen = static_cast<std::uint8_t>(count);
}

}  // namespace topo::pipeline
