// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/pipeline/mapping_step.hpp"
#include "core/pipeline/planning_step.hpp"
#include "tests/bench/topobench/explore/readings.hpp"

namespace topo::bench {

/// What the mapping and loop closure threads do, in lock-step.
class MapSource {
 public:
  virtual ~MapSource() = default;
  virtual void take(const Readings& readings) = 0;
  /// The newest snapshot, never null. Good until the next take().
  [[nodiscard]] virtual const pipeline::MapSnapshot& map() const = 0;
  [[nodiscard]] virtual const pipeline::TrackedPose& tracked() const = 0;
  /// Motion by scan matching; null where poses are given and nothing is matched.
  [[nodiscard]] virtual const plausibility::MatchedMotion* matched() const { return nullptr; }
};

/// Keyframes and relations of a robot, its own or a mate's. In fidelity "plan" a keyframe's dead reckoning is
/// its pose in the map that all robots have.
struct TeamNews {
  std::vector<slam::KeyframePtr> keyframes;
  std::vector<slam::FoundRelation> relations;
  [[nodiscard]] bool empty() const { return keyframes.empty() && relations.empty(); }
};

/// One that makes its map of a team's keyframes.
class SharedMapSource : public MapSource {
 public:
  /// From a team-mate; each keyframe and each relation once.
  virtual void join(const TeamNews& news) = 0;
  /// The robot's own since the last call.
  virtual TeamNews take_new() = 0;
  /// Where the newest scan has the robot.
  [[nodiscard]] virtual const types::Se2& T_map_base() const = 0;
  /// Where this map has a keyframe, one's own or another's; null when it is not in it.
  [[nodiscard]] virtual const types::Se2* find_pose(const slam::KeyframeId& id) const = 0;
  /// The robot's map frame in this one; nothing as long as that is not known.
  [[nodiscard]] virtual std::optional<types::Se2> T_map_mates(std::uint16_t robot) const = 0;
};

/// Who joins maps with whom.
struct SlamTeam {
  slam::Origin origin;
  /// Where the robots started, in the frame of all maps, by id. Empty: nobody knows, every robot's map begins
  /// at its own start, and a team-mate is joined when it is found in the map.
  std::vector<types::Se2> starts;
};

/// The mapper on every scan. A loop question is answered exactly `closure_delay_scans` front scans later.
std::unique_ptr<SharedMapSource> make_slam_source(const slam::MapperParams& params, int closure_delay_scans,
                                                  SlamTeam team = {});

/// Fidelity "plan": keyframes at the poses of Readings::poses, drawn by the mapper's own map builder. All
/// robots have one map frame, and relations are not needed.
std::unique_ptr<SharedMapSource> make_posed_source(const slam::MapperParams& params, std::uint16_t robot = 0);

}  // namespace topo::bench
