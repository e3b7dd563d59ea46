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
#include "core/pipeline/mapping_step.hpp"
#include "core/pipeline/plan.hpp"
#include "core/pipeline/planning_step.hpp"
#include "core/slam/graph_solution.hpp"
#include "core/slam/loop_closure.hpp"
#include "core/sync/estop_line.hpp"
#include "core/sync/latest.hpp"
#include "core/sync/ring.hpp"
#include "core/sync/snapshot_cell.hpp"
#include "core/types/base_state.hpp"
#include "core/types/scan.hpp"
#include "daemon/threads/fixed_text.hpp"
#include "daemon/threads/session_desk.hpp"
#include "daemon/threads/wakeup.hpp"
#include "drivers/io/bus_faults.hpp"

namespace topo::daemon {

/// What a device's thread tells main of it.
struct DeviceReport {
  FixedText<24> state;      ///< "streaming"
  FixedText<240> message;   ///< one sentence for a person
  FixedText<120> identity;  ///< model, serial number, firmware
  bool working = false;
  int watchdog_ms = -1;                     ///< of the base's firmware; negative: not known yet
  std::array<std::uint64_t, 6> counters{};  ///< as the driver's Counters
  io::BusFaults bus;                        ///< of the base, when it is on one
};

/// What the base thread tells main; planning gets `control` alone.
struct BaseReport {
  types::BaseState state;
  bool ready = false;  ///< the session takes commands
  pipeline::ControlReport control;
};

struct MappingReport {
  std::uint64_t revision = 0;
  std::uint64_t keyframes = 0;
  std::uint64_t matched = 0;
  std::uint64_t lost = 0;          ///< scans that matched nothing
  pipeline::MappingLosses losses;  ///< scans that were taken and never placed, of all maps
  std::uint64_t closures_accepted = 0;
  std::uint64_t closures_rejected = 0;
  double response = 0.0;
  std::uint64_t map = 1;  ///< one more for every session that was taken over
  types::Transform2<types::Map, types::Odom> T_map_odom;
};

/// How the journal of the session fares.
struct JournalReport {
  FixedText<80> name;  ///< of the session's file
  std::uint64_t keyframes = 0;
  std::uint64_t bytes = 0;
  std::uint64_t failures = 0;  ///< writes that the disk refused
  bool failing = false;        ///< the newest one was
  FixedText<200> message;      ///< of the newest failure
};

inline constexpr std::size_t kScanRing = 32;  ///< 0.8 s at 40 Hz
inline constexpr std::size_t kOdometryRing = 64;
inline constexpr std::size_t kSnapshotReaders = 2;
inline constexpr std::size_t kFilesReader = 0;
inline constexpr std::size_t kPlanningReader = 1;
inline constexpr std::size_t kReportReaders = 2;
inline constexpr std::size_t kMainReader = 1;  ///< of planning's reports; kFilesReader is the other

using MapSnapshots = sync::SnapshotCell<pipeline::MapSnapshot, kSnapshotReaders>;
using PlanningReports = sync::SnapshotCell<pipeline::PlanningReport, kReportReaders>;

/// One scanner's way out.
struct ScanHandOver {
  sync::Ring<types::Scan, kScanRing> to_mapping;
  sync::Latest<types::Scan> to_base;      ///< the front scanner's only
  sync::Latest<types::Scan> to_planning;  ///< the front scanner's only
  sync::Latest<DeviceReport> report;
};

/// Everything that goes from one thread to another (DESIGN section 2). Large: for the heap.
struct HandOvers {
  std::atomic<bool> devices_closing{false};  ///< first of all: the base's and the scanners' threads end
  std::atomic<bool> stopping{false};         ///< then every other thread but mapping's
  std::atomic<bool> readers_gone{false};     ///< nobody pins maps any more: the mapping thread ends

  ScanHandOver front, coronal;

  // Main to base.
  sync::EStopLine<> estop;
  sync::Latest<pipeline::Teleop> drive;

  // Main to planning.
  Wakeup planning_wakeup;
  sync::Latest<pipeline::Mission> mission;

  // Planning to base and main.
  sync::Latest<pipeline::Plan> plan;
  /// Made before the threads start, ended by the planning thread, which alone destroys reports.
  std::unique_ptr<PlanningReports> planning = std::make_unique<PlanningReports>();

  // Base to planning, mapping and main.
  sync::Latest<pipeline::ControlReport> control_to_planning;
  sync::Ring<types::Odometry, kOdometryRing> odometry;
  sync::Latest<DeviceReport> base_device;
  sync::Latest<BaseReport> base_report;

  // Mapping.
  Wakeup mapping_wakeup;
  sync::Latest<MappingReport> mapping_report;
  sync::Latest<pipeline::TrackedPose> tracked;  ///< to planning
  /// Made before the threads start, ended by the mapping thread, which alone may destroy snapshots.
  std::unique_ptr<MapSnapshots> map = std::make_unique<MapSnapshots>();

  // Mapping to loop closure and back.
  Wakeup closure_wakeup;
  sync::Ring<slam::LoopQuery, 4> loop_queries;
  sync::Ring<slam::LoopAnswer, 8> loop_answers;
  sync::Ring<slam::GraphQuery, 2> graph_queries;
  sync::Ring<slam::GraphSolution, 2> graph_solutions;

  // Sessions: the journal's and main's background thread ask, mapping answers.
  SessionDesk journal_desk, files_desk;
  /// Main's background thread to mapping: a map to go on with in the place of the present one.
  sync::Ring<Parcel<pipeline::MappingState>, 2> take_over;
  std::atomic<bool> journal_held{false};  ///< main: nothing is written for the time being
  Wakeup journal_wakeup;
  sync::Latest<JournalReport> journal_report;
};

}  // namespace topo::daemon
