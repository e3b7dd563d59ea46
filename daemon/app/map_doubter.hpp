// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/slam/doubt/map_doubt.hpp"
#include "core/types/result.hpp"
#include "daemon/control/json_rpc.hpp"
#include "daemon/threads/hand_overs.hpp"

namespace topo::daemon {

/// What speaks against the present map.
struct FoundDoubt {
  slam::MapDoubt doubt;
  std::uint64_t map = 0;       ///< MappingReport::map; 0: nothing was found yet
  std::uint64_t revision = 0;  ///< of that map
  /// Poses at which the robot was before, one beside each doubted region.
  std::vector<types::Vector2> look_again;
};

/// Holds the present map against itself. Blocks, for a second with a map of some thousand keyframes; one
/// thread at a time.
class MapDoubter {
 public:
  /// `client` is used by the calling thread of find().
  MapDoubter(HandOvers& hand_overs, SessionClient& client, std::uint16_t robot,
             const slam::GraphParams& params)
      : snapshots_(hand_overs.mapping.map->reader(kDoubtReader)),
        client_(client),
        robot_(robot),
        params_(params) {}

  /// `scans`: those of this run. kTimeout when the mapping thread does not answer; kNotFound before the first
  /// keyframe.
  types::Result<FoundDoubt> find(const slam::ScanCount& scans);

 private:
  MapSnapshots::Reader snapshots_;
  SessionClient& client_;
  std::uint16_t robot_;
  slam::GraphParams params_;
};

/// For each region the pose on the own way that is nearest to it: a robot can stand where it stood. Loose
/// steps need no look of their own: the start is before all of them, and an exploration ends there.
[[nodiscard]] std::vector<types::Vector2> stands_beside(std::span<const slam::RevisitRegion> regions,
                                                        std::span<const types::Se2> poses, slam::Way own_way);

/// The content of doubt.json: doubt_json() of the map, and its revision.
[[nodiscard]] Json doubt_json(const FoundDoubt& found);

/// The scans of this run.
[[nodiscard]] inline slam::ScanCount scan_count(const MappingReport& report) {
  return {report.matched + report.lost, report.lost, report.degenerate};
}

}  // namespace topo::daemon
