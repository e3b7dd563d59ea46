// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/slam/doubt/revisit.hpp"
#include "core/slam/loop_candidates.hpp"
#include "core/slam/params.hpp"
#include "core/slam/session.hpp"

namespace topo::slam {

/// When a map is doubted. Chosen on the logs and simulated runs of doc/results.md, section "Mapping".
struct DoubtLimits {
  std::uint64_t region_points = 200;  ///< fewer points of a region say nothing
  double region_contradicted = 0.5;   ///< share of a region's points that another visit contradicts, from
                                      ///< which on the region is doubted
  double contradicted = 0.14;         ///< share of all points in doubted regions, of a map that is doubted
  double lost = 0.1;                  ///< share of the scans; a good log loses none
  double tension = 0.2;               ///< share of closures that the solution of the graph contradicts
  double degenerate = 0.5;            ///< share of the scans that leave one direction to odometry
  double loose_rad = 0.035;  ///< standard deviation of the heading at the end of the way by its loose
                             ///< steps (LooseStep)
  double loose_m = 0.4;      ///< the same of the position, not counting what heading does to it
  double odometry_at_fault =
      0.1;  ///< share of the matches that odometry contradicts, above which it is false
};

/// What became of the scans of a run.
struct ScanCount {
  std::uint64_t scans = 0;
  std::uint64_t lost = 0;        ///< placed by odometry alone
  std::uint64_t degenerate = 0;  ///< that left one direction to odometry
};

/// A step of the own way that goes by what odometry alone says, or against odometry, beyond
/// GraphParams::loose_rad or loose_m, and that no closure spans: what was mapped before and after it may be
/// turned or shifted against each other. How it turns is known where the keyframes before and after it see
/// walls of one direction (heading_evidence.hpp), and it is too certain for these to be of another wing or
/// quarter.
struct LooseStep {
  types::Vector2 before{0.0, 0.0};  ///< where it begins, in map
  double sigma_rad = 0.0;           ///< 0: the walls say how it turns
  double sigma_m = 0.0;             ///< along the less certain direction
};

/// What is counted against a map.
enum class DoubtReason : std::uint8_t {
  kLost,          ///< scans that fit nowhere
  kContradicted,  ///< what was seen twice was elsewhere the other time
  kTension,       ///< closures contradict each other
  kLoose,         ///< odometry alone says how the robot turned,
  kShifted,       ///< or how far it went
  kDegenerate,    ///< scans leave one direction to odometry
};

/// What speaks against a map; needs no truth. Shares from 0 to 1.
struct MapDoubt {
  double contradicted = 0.0, lost = 0.0, tension = 0.0, degenerate = 0.0;
  double loose_rad = 0.0, loose_m = 0.0;
  double figure = 0.0;                      ///< the greatest of them over its limit
  DoubtReason reason = DoubtReason::kLost;  ///< which one that is
  ScanCount scans;
  std::vector<RevisitRegion> regions;  ///< doubted ones
  std::vector<LooseStep> loose;        ///< by the edges

  [[nodiscard]] bool is_doubted() const { return figure > 1.0; }
};

/// Share of a region's points that another visit contradicts.
[[nodiscard]] double contradicted_share(const RevisitRegion& region);

/// `own_way`: nodes of the robot whose map it is, ascending. Costs O(edges log keyframes).
[[nodiscard]] MapDoubt doubt_of(const Session& map, Way own_way, const GraphParams& params,
                                const ScanCount& scans, const RevisitShare& revisits,
                                const DoubtLimits& limits = {});

}  // namespace topo::slam
