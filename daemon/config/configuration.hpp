// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/pipeline/control_step.hpp"
#include "core/pipeline/planning_params.hpp"
#include "core/plausibility/params.hpp"
#include "core/slam/params.hpp"
#include "core/types/area_limits.hpp"
#include "core/types/battery.hpp"
#include "core/types/robot_limits.hpp"
#include "core/types/se2.hpp"
#include "core/types/sector.hpp"
#include "core/types/wheel_calibration.hpp"

namespace topo::daemon {

// The values of one configuration file. The initialisers here are the defaults, except for those taken from
// the parameter structures of core. Names, units, ranges and descriptions of the keys are in key_table.cpp.

enum class RobotModel { kP3dx, kP3at };

struct RobotConfig {
  std::string name = "topometric";
  RobotModel model = RobotModel::kP3dx;
  int id = 1;
  // Hull around the centre of rotation, including all attachments; 0: the model's own.
  double length_front_m = 0.0;
  double length_rear_m = 0.0;
  double width_m = 0.0;
};

struct BaseConfig : types::DriveLimits {
  std::string address;        ///< format: drivers/io/make_connector.hpp
  std::string name;           ///< that the controller tells of itself; empty: any
  std::string serial_number;  ///< of the controller; empty: any
  std::string family;         ///< whose factors hold for a controller that names none; empty: it is refused
  int watchdog_ms = 0;        ///< of a firmware that does not tell its own; 0: such is not driven
  bool sonar = true;
  bool gyro = true;  ///< the heading by the gyro of a base that has one
  // Of this robot against its model, by `topoctl calibrate`.
  types::WheelCalibration wheels;
  double status_delay_s = 0.0;  ///< of status packets against scans
};

/// One scanner. Its frame is laser_front or laser_coronal.
struct ScannerConfig {
  bool present = false;  ///< its section is in the file
  std::string address;
  std::string serial_number;
  double x_m = 0.0;
  double y_m = 0.0;
  double z_m = 0.3;
  double yaw_rad = 0.0;  ///< front only: angle of the zero beam from straight ahead
  /// Coronal: angle of the zero beam from straight up towards the left. Front: turn about the zero beam, 0
  /// upright or pi upside down.
  double roll_rad = 0.0;
  bool mirrored = false;  ///< beams count towards the right; of the front scanner: clockwise from above
  types::Sectors
      masks{};  ///< not looked at; front: from straight ahead, coronal: from straight up, to the left
  bool intensity = false;
  int skip_scans = 0;
  double stamp_offset_s = 0.0;
};

/// The planner's settings. Defaults that the planner has too are taken from there.
struct ExplorationConfig {
  exploration::Strategy strategy = pipeline::PlannerParams{}.explore.strategy;
  std::string finish = "worth:0.1";  ///< exploration::parse_finish
  double planning_period_s = 0.4;
  double frontier_min_m = pipeline::PlannerParams{}.explore.frontier_min_m;
  double goal_reached_m = pipeline::PlannerParams{}.explore.pursuit.goal_reached_m;
  double home_reached_m = pipeline::PlannerParams{}.explore.homing.home_reached_m;
  double goal_give_up_s = pipeline::PlannerParams{}.explore.pursuit.give_up_s;
  double battery_home_v = pipeline::PlannerParams{}.battery.home_v;
  double charge_home = pipeline::PlannerParams{}.battery.charge_home;
  [[nodiscard]] types::BatteryLimits battery_limits() const { return {battery_home_v, charge_home}; }
  std::string save_folder;  ///< empty: the map is not saved automatically
};

struct MotionConfig {
  double margin_m = types::RobotLimits{}.margin_m;
  double passage_radius_m = 0.0;  ///< 0: derived from the hull
};

struct ControlConfig {
  std::string socket = "/run/topometric/control.sock";
  std::string group = "topometric";
  std::string state_folder = "/var/lib/topometric";  ///< empty: a latched e-stop is forgotten at the end
};

enum class LogLevel { kTrace, kDebug, kInfo, kWarning, kError };

struct LogConfig {
  LogLevel level = LogLevel::kInfo;
  std::string file;  ///< empty: standard error, which systemd passes to the journal
};

enum class RealtimePolicy { kEnforce, kTry, kOff };

struct RealtimeConfig {
  RealtimePolicy policy = RealtimePolicy::kTry;
  int base_priority = 45;
  int scan_priority = 40;
  std::vector<int> cpus;  ///< empty: any
  bool lock_memory = true;
};

struct RecordConfig {
  std::string folder;     ///< empty: no recording
  int quota_mb = 20'000;  ///< of the folder's recordings of this robot; 0: no limit
};

/// Sessions: saved maps that mapping can continue.
struct SessionConfig {
  std::string folder;  ///< empty: none are kept
  bool journal = true;
  double journal_period_s = 2.0;
  int keep = 5;                   ///< journals
  int quota_mb = 2000;            ///< of all journals; 0: no limit
  std::string resume = "killed";  ///< "killed", "last", a session's name, or empty
};

/// The team and the radio to it. Without the section the robot has no team.
struct TeamConfig {
  bool present = false;             ///< its section is in the file
  std::string name;                 ///< the same on every robot of the team
  int id = 0;                       ///< in a file without faults the same as RobotConfig::id
  std::vector<std::string> peers;   ///< IPv4 addresses of team-mates; empty: found by multicast
  std::string interface;            ///< network interface of the radio
  int domain = 0;                   ///< of DDS
  std::string security;             ///< folder of the credentials (topometric-team(8)), or "off"
  std::optional<types::Se2> start;  ///< in the team's common frame; nothing: unknown
  std::string socket = "/run/topometric/link.sock";
  [[nodiscard]] bool secure() const { return security != "off"; }
};

enum class ViewLook { kEverybody, kToken };

/// The operator's page, which topoview serves.
struct ViewConfig {
  std::string address = "127.0.0.1";  ///< IP address that it listens on
  int port = 8080;
  std::vector<std::string> hosts;  ///< names that a browser may call it by, beside addresses and its own name
  ViewLook look = ViewLook::kEverybody;
  std::string state_folder = "/var/lib/topometric/view";  ///< of the tokens
};

struct Configuration {
  RobotConfig robot;
  BaseConfig base;
  ScannerConfig front;
  ScannerConfig coronal;
  slam::MapperParams mapping;  ///< except for the scanners' poses, which mapper_params() adds
  ExplorationConfig exploration;
  topo::types::AreaLimits area;
  MotionConfig motion;
  plausibility::PlausibilityParams plausibility;
  ControlConfig control;
  LogConfig log;
  RealtimeConfig realtime;
  RecordConfig record;
  SessionConfig session;
  TeamConfig team;
  ViewConfig view;
};

/// The mapper's parameters with the scanners' configured poses.
[[nodiscard]] slam::MapperParams mapper_params(const Configuration& configuration);

/// The planner's parameters with the robot's size and its scanner's pose.
[[nodiscard]] pipeline::PlannerParams planner_params(const Configuration& configuration);

/// Setup of the base thread: the robot's limits, its hull, its scanner's pose and the area.
[[nodiscard]] pipeline::ControlSetup control_setup(const Configuration& configuration);

/// Parameters of the base thread's step, with what may be configured of them.
[[nodiscard]] pipeline::ControlParams control_params(const Configuration& configuration);

/// True when the front scanner's beams count clockwise seen from above.
[[nodiscard]] bool is_upside_down(const ScannerConfig& front);

/// The robot's hull: the configured one, or the model's.
[[nodiscard]] types::Footprint footprint(const Configuration& configuration);

/// Hull and speed of a model as sold (PROTOCOLS section 6.2), against which a configuration is checked.
[[nodiscard]] types::ModelSize model_size(RobotModel model);
[[nodiscard]] const char* model_name(RobotModel model);

}  // namespace topo::daemon
