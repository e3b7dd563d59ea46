// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/pipeline/whereabouts.hpp"

namespace topo::pipeline {
namespace {

/// The reason why the robot's pose is not known; null when it is.
const char* place_missing(const PlanningInput& in, types::Stamp matched, const WhereaboutsParams& params) {
  if (in.map == nullptr || in.map->keyframes.empty()) return "no map yet";
  if (in.control == nullptr || in.now - in.control->stamp > params.control_age_max)
    return "no word from the base thread";
  if (!in.control->base_ready) return "the base is not ready";
  if (in.tracked == nullptr || in.now - in.tracked->stamp > params.tracked_age_max)
    return "no scan was placed lately: the robot does not know where it is";
  if (in.now - matched > params.reckoned_max) return "lost: no scan has matched the map for two seconds";
  return nullptr;
}

}  // namespace

Whereabouts locate(Whereabouts before, const PlanningInput& in, const WhereaboutsParams& params) {
  Whereabouts now = std::move(before);
  if (in.tracked != nullptr && in.tracked->matched) now.matched = in.tracked->stamp;
  const char* missing = place_missing(in, now.matched, params);
  now.located = missing == nullptr;
  now.missing = now.located ? "" : missing;
  if (!now.located) return now;
  const bool newer = in.tracked->revision == in.map->revision;
  now.T_map_odom = newer ? in.tracked->T_map_odom : in.map->T_map_odom;
  now.T_map_base = now.T_map_odom * in.control->odometry.T_odom_base;
  now.T_map_start = in.map->keyframes.front().T_map_base;
  if (now.newest.is_bent(*in.map, params.bent_m, params.bent_rad)) ++now.bends;
  now.newest = NewestKeyframe(*in.map);
  if (in.control->estop_latched) now.missing = "emergency stop, to be cleared by the operator";
  return now;
}

}  // namespace topo::pipeline
