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

/// Of the commands for a scanner.
struct LaserArguments {
  std::string address, new_address, netmask = "255.255.255.0";
  std::string gateway;        ///< empty: the first host of the new address's network
  std::string serial_number;  ///< that it must report; empty: any
  double patience_s = 120.0;  ///< for the power cycle; 0: no wait
};

/// The command line.
struct Arguments {
  std::string socket = ControlConfig{}.socket;
  bool json = false;
  bool why = false;
  bool all = false;  ///< robots of the team
  std::string folder, level, what, session;
  bool search = false;       ///< load a session without a pose
  std::vector<double> pose;  ///< x, y, theta; or empty
  double v_mps = 0.0, omega_radps = 0.0, seconds = 1.0;
  double x_m = 0.0, y_m = 0.0;
  double timeout_s = 0.0;   ///< 0: no limit
  double interval_s = 1.0;  ///< of the command watch
  LaserArguments laser;
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

/// Sends an order to the whole team, and names who has acknowledged it and who was not reached.
int order_team(const Arguments& arguments, const char* method);

/// Sends a request, and prints the answer as JSON or through `table`. Returns the exit status.
int show(const Arguments& arguments, const char* method, std::string (*table)(const Json&),
         const Json& params = Json::object(), types::Duration patience = kPatience);

// Commands in files of their own; each returns the exit status.

int drive_for(const Arguments& arguments);
int drive_by_keys(const Arguments& arguments);
int set_laser_ip(const Arguments& arguments);
int watch(const Arguments& arguments);
int doctor(const Arguments& arguments);
int wait_done(const Arguments& arguments);
int wait_ready(const Arguments& arguments);
int save_session(const Arguments& arguments);
int load_session(const Arguments& arguments);
int confirm_session(const Arguments& arguments);

}  // namespace topo::daemon
