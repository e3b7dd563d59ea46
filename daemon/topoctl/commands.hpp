// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "daemon/config/configuration.hpp"
#include "daemon/topoctl/client.hpp"

namespace topo::daemon {

// Exit statuses, as in topoctl(1).
inline constexpr int kOk = 0;
inline constexpr int kFailed = 1;
// 2: wrong command line, see parse_command_line()
inline constexpr int kNoDaemon = 3;
inline constexpr int kTimedOut = 4;
inline constexpr int kMissionFailed = 5;

inline constexpr types::Duration kPatience = std::chrono::seconds(5);
/// The operator must learn quickly that there is no daemon.
inline constexpr types::Duration kEstopPatience = std::chrono::seconds(1);

/// The robots that an order is for.
struct WhomArguments {
  bool all = false;  ///< robots of the team
  int robot = 0;     ///< the one of the team; 0: this one
};

/// Of the command drive.
struct DriveArguments {
  double v_mps = 0.0, omega_radps = 0.0, seconds = 1.0;
};

/// Of the commands for a scanner.
struct LaserArguments {
  std::string address, new_address, netmask = "255.255.255.0";
  std::string gateway;        ///< empty: the first host of the new address's network
  std::string serial_number;  ///< that it must report; empty: any
  double patience_s = 120.0;  ///< for the power cycle; 0: no wait
};

/// Of the command setup. Empty lists: the usual places.
struct SetupArguments {
  std::string config = "/etc/topometric/topometric.toml";
  std::vector<std::string> serial, tcp, bases;
  double countdown_s = 5.0;  ///< at a terminal, between the Enter key and the look: to walk there
};

/// Of the command calibrate.
struct CalibrationArguments {
  std::string config, recording;
  bool drive = false;  ///< the built-in figure first, by the daemon
  bool write = false;  ///< into the configuration, when it is believable
};

/// Of the command that draws an area.
struct AreaArguments {
  std::vector<double> corners;  ///< x, y of each
  bool first = false;           ///< to go to first, instead of keeping out
};

/// Of the command for the page's tokens.
struct ViewArguments {
  std::string config = "/etc/topometric/topometric.toml";
  std::string name = "browser";  ///< of the token
};

/// The command line.
struct Arguments {
  std::string socket = ControlConfig{}.socket;
  bool json = false;
  bool why = false;
  WhomArguments whom;
  std::string folder, level, what, session;
  bool search = false;       ///< load a session without a pose
  std::vector<double> pose;  ///< x, y, theta; or empty
  AreaArguments area;
  DriveArguments drive;
  double x_m = 0.0, y_m = 0.0;
  double timeout_s = 0.0;   ///< 0: no limit
  double interval_s = 1.0;  ///< of the command watch
  LaserArguments laser;
  SetupArguments setup;
  CalibrationArguments calibration;
  ViewArguments view;
};

/// True after SIGINT, SIGTERM or SIGHUP, once catch_signals() was called.
[[nodiscard]] bool interrupted();
void catch_signals();

/// Sleeps until `when`; ends early when interrupted().
void pause_until(types::Stamp when);
/// Client::next_event() that ends early, with kTimeout, when interrupted().
types::Result<Json> next_event_until(Client& client, types::Stamp deadline);

/// The exit status for an error of a call to the daemon.
[[nodiscard]] int status_of(const types::Error& error);
/// Prints the error; returns the exit status for it.
int complain(const types::Error& error);

/// JSON in this program's output format; invalid UTF-8 is replaced.
std::string pretty(const Json& json);
std::string one_line(const Json& json);

/// Sends one request on a separate connection.
types::Result<Json> ask(const Arguments& arguments, const char* method, const Json& params = Json::object(),
                        types::Duration patience = kPatience);

/// Sends an order to the whole team, or to the one robot of the arguments, and names the robots that have
/// acknowledged it, those that refuse it with the reason, and those that were not reached.
int order_team(const Arguments& arguments, const char* method);
/// The same, or an order to this robot, by the arguments.
int order(const Arguments& arguments, const char* method);

/// Sends a request, and prints the answer as JSON or through `table`. Returns the exit status.
int show(const Arguments& arguments, const char* method, std::string (*table)(const Json&),
         const Json& params = Json::object(), types::Duration patience = kPatience);

// Commands in files of their own; each returns the exit status.

int drive_for(const Arguments& arguments);
int drive_by_keys(const Arguments& arguments);
int set_laser_ip(const Arguments& arguments);
int set_up(const Arguments& arguments);
int calibrate_robot(const Arguments& arguments);
int wheels_up(const Arguments& arguments);
int watch(const Arguments& arguments);
int doctor(const Arguments& arguments);
int wait_done(const Arguments& arguments);
int wait_ready(const Arguments& arguments);
int save_session(const Arguments& arguments);
int load_session(const Arguments& arguments);
int confirm_session(const Arguments& arguments);
/// Becomes topoview pair; returns only where that is not installed.
int pair_browser(const Arguments& arguments);

}  // namespace topo::daemon
