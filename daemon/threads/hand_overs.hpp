// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>

#include "core/motion/velocity_gate.hpp"
#include "core/pipeline/control_step.hpp"
#include "core/pipeline/map_snapshot.hpp"
#include "core/pipeline/mapping_losses.hpp"
#include "core/pipeline/plan.hpp"
#include "core/pipeline/planning_step.hpp"
#include "core/slam/alignment.hpp"
#include "core/slam/arrival_trial.hpp"
#include "core/slam/graph_solution.hpp"
#include "core/slam/loop_closure.hpp"
#include "core/sync/estop_line.hpp"
#include "core/sync/latest.hpp"
#include "core/sync/ring.hpp"
#include "core/sync/snapshot_cell.hpp"
#include "core/types/area_limits.hpp"
#include "core/types/base_state.hpp"
#include "core/types/place_standing.hpp"
#include "core/types/scan.hpp"
#include "daemon/threads/fixed_text.hpp"
#include "daemon/threads/log_lines.hpp"
#include "daemon/threads/session_desk.hpp"
#include "daemon/threads/team_hand_over.hpp"
#include "daemon/threads/wakeup.hpp"
#include "drivers/io/bus_faults.hpp"

namespace topo::daemon {

/// Report of a device's thread to main.
struct DeviceReport {
  FixedText<24> state;      ///< "streaming"
  FixedText<240> message;   ///< one sentence for the operator
  FixedText<120> identity;  ///< model, serial number, firmware
  FixedText<160> assumed;   ///< what is taken for granted of a device that is not known exactly
  bool working = false;
  int watchdog_ms = -1;                     ///< of the base's firmware; negative: unknown
  bool watchdog_given = false;              ///< by the configuration, not by the firmware
  std::array<std::uint64_t, 6> counters{};  ///< as the driver's Counters
  io::BusFaults bus;                        ///< of the base, when it is on a bus
};

/// Report of the base thread to main; planning receives only `control`.
struct BaseReport {
  types::BaseState state;
  bool ready = false;  ///< the connection accepts commands
  pipeline::ControlReport control;
};

struct MappingReport {
  std::uint64_t revision = 0;
  std::uint64_t keyframes = 0;         ///< the robot's own
  std::uint64_t keyframes_of_all = 0;  ///< in the map, with those of mates
  std::uint64_t matched = 0;
  std::uint64_t lost = 0;          ///< scans that matched nothing
  std::uint64_t degenerate = 0;    ///< scans that left one direction to odometry
  pipeline::MappingLosses losses;  ///< scans that were taken but never placed, over all maps
  std::uint64_t closures_accepted = 0;
  std::uint64_t closures_rejected = 0;
  double response = 0.0;
  std::uint64_t map = 1;  ///< 1, plus one for every session taken over
  types::Transform2<types::Map, types::Odom> T_map_odom;
  slam::TrialCount trial;  ///< of the map `map`
};

/// State of the session's journal.
struct JournalReport {
  FixedText<80> name;  ///< of the session's file
  std::uint64_t keyframes = 0;
  std::uint64_t bytes = 0;
  std::uint64_t failures = 0;  ///< failed writes
  bool failing = false;        ///< the newest write failed
  FixedText<200> message;      ///< of the newest failure
};

inline constexpr std::size_t kScanRing = 32;  ///< 0.8 s at 40 Hz
inline constexpr std::size_t kOdometryRing = 64;
inline constexpr std::size_t kSnapshotReaders = 4;
inline constexpr std::size_t kFilesReader = 0;
inline constexpr std::size_t kPlanningReader = 1;
inline constexpr std::size_t kViewReader = 2;  ///< of maps, for displays
inline constexpr std::size_t kDoubtReader = 3;
inline constexpr std::size_t kReportReaders = 2;
inline constexpr std::size_t kMainReader = 1;  ///< of planning's reports; kFilesReader is the other

using MapSnapshots = sync::SnapshotCell<pipeline::MapSnapshot, kSnapshotReaders>;
using PlanningReports = sync::SnapshotCell<pipeline::PlanningReport, kReportReaders>;

/// Output of one scanner's thread.
struct ScanHandOver {
  sync::Ring<types::Scan, kScanRing> to_mapping;
  sync::Latest<types::Scan> to_base;      ///< front scanner only
  sync::Latest<types::Scan> to_planning;  ///< front scanner only
  sync::Latest<types::Scan> to_main;      ///< front scanner only: for displays
  sync::Latest<DeviceReport> report;
};

/// The order in which the threads end.
struct Ending {
  std::atomic<bool> devices_closing{false};  ///< first: the base's and the scanners' threads
  std::atomic<bool> stopping{false};         ///< then: all other threads except mapping
  std::atomic<bool> readers_gone{false};     ///< last: no reader pins maps, and the mapping thread ends
};

/// From main, base and mapping.
struct ToPlanning {
  Wakeup wakeup;
  sync::Latest<pipeline::Mission> mission;
  sync::Latest<pipeline::ControlReport> control;
  sync::Latest<pipeline::TrackedPose> tracked;
  sync::Latest<types::AreaLimits> area;                  ///< from main: all area limits that are in force
  sync::Latest<std::vector<types::Polygon>> here_first;  ///< from main: areas whose goals come first
  sync::Latest<std::vector<types::Vector2>> doubted;     ///< from main: where the map is doubted
};

/// Output of the base thread.
struct BaseHandOver {
  sync::Ring<types::Odometry, kOdometryRing> odometry;  ///< to mapping
  sync::Latest<DeviceReport> device;
  sync::Latest<BaseReport> report;
};

struct MappingHandOver {
  MappingHandOver();
  ~MappingHandOver();
  MappingHandOver(const MappingHandOver&) = delete;
  MappingHandOver& operator=(const MappingHandOver&) = delete;
  Wakeup wakeup;
  sync::Latest<MappingReport> report;
  sync::Latest<plausibility::MatchedMotion> to_base;
  /// Created before the threads start, destroyed by the mapping thread, which alone may destroy snapshots.
  std::unique_ptr<MapSnapshots> map;
  /// From main's background thread: a map that replaces the current one.
  sync::Ring<Parcel<pipeline::MappingState>, 2> take_over;
};

/// From mapping to loop closure and back.
struct ClosureHandOver {
  Wakeup wakeup;
  sync::Ring<slam::LoopQuery, 4> loop_queries;
  sync::Ring<slam::LoopAnswer, 8> loop_answers;
  sync::Ring<slam::GraphQuery, 2> graph_queries;
  sync::Ring<slam::GraphSolution, 2> graph_solutions;
  sync::Ring<slam::AlignmentQuery, 2> alignment_queries;
  sync::Ring<slam::Alignment, 2> alignments;
};

struct JournalHandOver {
  SessionDesk desk;               ///< requests of the journal thread, answered by mapping
  std::atomic<bool> held{false};  ///< set by main: nothing is written for the time being
  Wakeup wakeup;
  LogLines log;
  sync::Latest<JournalReport> report;
};

/// To the base: how far the robot's place in the map is known.
struct PlaceHandOver {
  /// From main, and from its background thread at the moment when it hands over a session.
  std::atomic<types::PlaceStanding> standing{types::PlaceStanding::kKnown};
  /// From mapping, at once: the present map did not match in the first metres.
  std::atomic<bool> dropped{false};
  /// From main: there are area limits, so that a wrong place would lead through forbidden areas.
  std::atomic<bool> limited{false};

  [[nodiscard]] types::PlaceStanding now() const {
    if (dropped.load(std::memory_order_acquire)) return types::PlaceStanding::kDropped;
    return standing.load(std::memory_order_acquire);
  }
};

/// All data passed between threads (DESIGN section 2). Large: allocate it on the heap.
struct HandOvers {
  Ending ending;
  ScanHandOver front, coronal;
  sync::EStopLine<> estop;               ///< main to base
  sync::Latest<pipeline::Teleop> drive;  ///< main to base
  sync::Latest<types::AreaLimits> area;  ///< main to base: all area limits that are in force
  ToPlanning to_planning;
  sync::Latest<pipeline::Plan> plan;  ///< planning to base and main
  /// Created before the threads start, destroyed by the planning thread, which alone destroys reports.
  std::unique_ptr<PlanningReports> planning = std::make_unique<PlanningReports>();
  BaseHandOver base;
  PlaceHandOver place;
  MappingHandOver mapping;
  ClosureHandOver closure;
  JournalHandOver journal;
  TeamHandOver team;
  SessionDesk files_desk;  ///< requests of main's background thread, answered by mapping
};

}  // namespace topo::daemon
