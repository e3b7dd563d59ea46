// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/slam/free_ground.hpp"
#include "core/slam/params.hpp"
#include "core/slam/session.hpp"
#include "core/slam/surfel_map.hpp"

namespace topo::slam {

/// How the first metres in a map that goes on are held against that map.
struct TrialParams {
  double way_m = 8.0;  ///< driven until the place counts as right: through a room of usual size and its door
  double way_max_m = 15.0;  ///< the same where most of what is seen is new: through the next room
  double thin_m = 0.05;     ///< cell size of the older map's surfels, as WholeSearch::thin_m
  double step_m = 0.10;     ///< a scan is compared after this way,
  double step_rad = 0.10;   ///< or this turn: a standing robot learns nothing more
  double drift_m = 0.10;  ///< standard deviations of the tracked pose in the older map: odometry's over some
  double drift_rad = 0.03;  ///< metres (MotionNoise), and a correction of the map
  /// A smaller share of points with an old surface in reach says nothing: the ground is new.
  double overlap_min = 0.30;
  /// Least share of those points that fit. TrackParams::response_good is for a map of the same minute; this
  /// is for one that furniture and doors have changed since (LocaliseParams::response_min over overlap_min).
  double fit_min = 0.65;
  /// Greatest share of points on ground that was seen free, or behind an old surface. A person 1 m away takes
  /// 30 degrees of 270, an eighth.
  double contradiction_max = 0.15;
  int recent = 10;                ///< of so many scans in a row that say something
  int recent_contradictions = 6;  ///< so many contradict: the place is dropped at once
  double matched_min = 0.60;      ///< least share of scans that match, at the end
  double rival_ratio = 0.90;  ///< a scan that a rival place explains this well says nothing (LocaliseParams)
};

/// One scan held against the older map. Shares of its points.
struct TrialEvidence {
  bool tracked = true;         ///< false: the scan fits nowhere near
  double overlap = 0.0;        ///< an old surface is in reach
  double fit = 0.0;            ///< of those, that lie on it
  double contradiction = 0.0;  ///< on ground that was seen free, or behind an old surface
  bool fits_rival = false;     ///< another place explains it nearly as well
};
enum class TrialFinding : std::uint8_t { kMatches, kContradicts, kSaysNothing };
[[nodiscard]] TrialFinding finding_of(const TrialEvidence& evidence, const TrialParams& params);

enum class TrialVerdict : std::uint8_t { kNone, kRunning, kPassed, kDropped };

/// Progress of a trial. A value.
struct TrialCount {
  double way_m = 0.0;
  int matched = 0, contradicted = 0, silent = 0;  ///< scans compared
  std::uint32_t recent = 0;  ///< of the last scans that say something a bit each, set: contradicts
  int recent_count = 0;
  TrialVerdict verdict = TrialVerdict::kNone;
};
/// The count with one scan more, and the verdict on it. A verdict that is not kRunning stays.
[[nodiscard]] TrialCount counted(TrialCount before, TrialFinding finding, double way_m,
                                 const TrialParams& params);

/// Holds the scans of the first metres against the surfaces and the free ground of the map alone that the
/// robot was placed in: the new keyframes would agree with themselves. State of one thread.
class ArrivalTrial {
 public:
  /// The older map within the scanner's reach of the first metres, at the arrival and its rivals.
  /// Precondition: check_session().
  ArrivalTrial(const Session& session, const Arrival& arrival, const MapperParams& mapper,
               const TrialParams& params = {});

  /// Takes a tracked scan in base_link; `matched`: false when tracking lost it.
  void add(const Cloud& cloud, const types::Se2& T_map_base, const types::Se2& T_odom_base, bool matched);
  [[nodiscard]] const TrialCount& count() const { return count_; }

 private:
  [[nodiscard]] TrialEvidence evidence(const Cloud& cloud, const types::Se2& T_map_base);
  [[nodiscard]] TrialEvidence evidence_at(const Point& sensor, const types::Se2& T_map_base) const;
  [[nodiscard]] double seen_through_share(const Point& sensor, const types::Se2& T_map_base) const;

  MapperParams mapper_;
  TrialParams params_;
  SurfelMap old_;
  FreeGround ground_;
  std::vector<types::Se2> T_rival_map_;  ///< from the map as the arrival has it to the map as a rival has it
  std::vector<Point> points_;            ///< scratch
  std::optional<types::Se2> compared_;   ///< T_odom_base of the last scan that was compared
  TrialCount count_;
};

}  // namespace topo::slam
