// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <filesystem>

#include "daemon/app/command_line.hpp"
#include "daemon/app/version.hpp"
#include "daemon/topoctl/commands.hpp"
#include "daemon/topoctl/tables.hpp"
#include "drivers/io/run_program.hpp"

namespace topo::daemon {
namespace {

constexpr types::Duration kEstopPatience = std::chrono::seconds(1);
constexpr types::Duration kSavePatience = std::chrono::minutes(2);
constexpr types::Duration kSearchPatience = std::chrono::seconds(30);

// Bounds against typing errors; the daemon checks the actual limits.
constexpr double kFar_m = 1e6, kFast = 100.0;

std::string nothing(const Json&) { return {}; }

std::string member(const Json& answer, const char* name) {
  const auto found = answer.find(name);
  return found != answer.end() && found->is_string() ? found->get<std::string>() : std::string("-");
}

/// With --all: of the whole team. Uses a short time-out: the operator must learn quickly when there is no
/// daemon.
int estop(const Arguments& arguments) {
  if (arguments.all) return order_team(arguments, "estop");
  const int status = show(arguments, "estop", &nothing, Json::object(), kEstopPatience);
  if (status == kNoDaemon)
    fmt::print(
        stderr,
        "topoctl: topometric-estop --config FILE stops the robot without the daemon, and with --force ends "
        "one that hangs\n");
  return status;
}

int save_map(const Arguments& arguments) {
  // The daemon's working folder differs from the caller's.
  std::error_code error;
  const auto folder = std::filesystem::absolute(arguments.folder, error).lexically_normal();
  if (error) return complain({types::Errc::kIo, error.message(), 0});
  const auto table = [](const Json& a) { return fmt::format("map saved to {}\n", member(a, "dir")); };
  return show(arguments, "map.save", table, Json{{"dir", folder.string()}}, kSavePatience);
}

/// Adds one subcommand with its name, help and action.
void add(CLI::App& parent, const char* name, const char* help, int& status, std::function<int()> act) {
  parent.add_subcommand(name, help)->callback([&status, act = std::move(act)] { status = act(); });
}

void add_queries(CLI::App& cli, Arguments& a, int& status) {
  add(cli, "status", "where the robot is and what it does", status,
      [&a] { return show(a, "status", &status_table); });
  add(cli, "watch", "the status on one line again and again, until the mission has ended", status,
      [&a] { return watch(a); });
  cli.get_subcommand("watch")
      ->add_option("--every", a.interval_s, "seconds (1)")
      ->check(number_from(0.1, 3600.0));
  add(cli, "doctor", "why the robot will not move, each with its cure; status 1 when anything is bad", status,
      [&a] { return doctor(a); });
  add(cli, "health", "what is wrong, if anything", status, [&a] { return show(a, "health", &health_table); });
  add(cli, "latency", "wake-up latency and run time of the threads", status,
      [&a] { return show(a, "latency", &latency_table); });
  add(cli, "goals", "where the robot may go next", status,
      [&a] { return show(a, "goals", a.why ? &why_table : &goals_table); });
  cli.get_subcommand("goals")->add_flag("--why", a.why, "why each goal was taken, dropped or put off");
  add(cli, "team", "who is in the team, what it hears and what it lacks", status,
      [&a] { return show(a, "team", &team_table); });
  add(cli, "places", "the places of the map", status, [&a] { return show(a, "places", &places_table); });
  add(cli, "version", "version of the daemon and of this program", status, [&a] {
    return show(a, "version", [](const Json& answer) {
      return fmt::format("topometricd {}\ntopoctl {}\n", member(answer, "version"), kVersion);
    });
  });
  add(cli, "config", "every effective value of the configuration, with its origin", status,
      [&a] { return show(a, "config", [](const Json& answer) { return member(answer, "text"); }); });
}

void add_commands(CLI::App& cli, Arguments& a, int& status) {
  add(cli, "estop", "stop at once, and stay so until clear-estop; anybody may", status,
      [&a] { return estop(a); });
  cli.get_subcommand("estop")->add_flag("--all", a.all, "of the whole team, and name who was not reached");
  add(cli, "clear-estop", "let the robot move again", status,
      [&a] { return show(a, "clear_estop", &nothing); });
  auto* driving = cli.add_subcommand("drive", "drive by hand: with the keys, or at V m/s and W rad/s");
  auto* v = driving->add_option("V", a.v_mps, "forward speed in m/s; without V and W the keys drive")
                ->check(number_from(-kFast, kFast));
  auto* w = driving->add_option("W", a.omega_radps, "turning speed in rad/s, counter-clockwise")
                ->check(number_from(-kFast, kFast));
  v->needs(w);
  driving->add_option("--for", a.seconds, "seconds (1), then stop")->check(number_from(0.0, 3600.0));
  driving->callback([&status, &a, v] { status = v->count() > 0 ? drive_for(a) : drive_by_keys(a); });
  add(cli, "log-level", "the least important message still logged", status, [&a] {
    return show(a, "log_level", &nothing, Json{{"level", a.level}});
  });
  cli.get_subcommand("log-level")
      ->add_option("LEVEL", a.level, "trace, debug, info, warning or error")
      ->required();
  auto* map = cli.add_subcommand("map", "the map");
  map->require_subcommand(1);
  add(*map, "save", "write the map's files into DIR", status, [&a] { return save_map(a); });
  map->get_subcommand("save")
      ->add_option("DIR", a.folder,
                   "a folder that the daemon may write to; it is made when only it is missing")
      ->required();
}

void add_sessions(CLI::App& cli, Arguments& a, int& status) {
  auto* session = cli.add_subcommand("session", "maps that can be gone on with");
  session->require_subcommand(1);
  add(*session, "list", "the sessions that are kept", status,
      [&a] { return show(a, "session.list", &sessions_table); });
  add(*session, "new", "the map made since the start is the map, no older one is gone on with", status,
      [&a] { return show(a, "session.new", &nothing); });
  add(*session, "save", "keep the map, and all that it is made of, as NAME", status,
      [&a] { return save_session(a); });
  add(*session, "load", "go on with session NAME, when the robot is found in its map", status,
      [&a] { return load_session(a); });
  add(*session, "confirm", "the robot is where it is proposed in the session's map, or at --pose", status,
      [&a] { return confirm_session(a); });
  for (const char* name : {"save", "load"})
    session->get_subcommand(name)->add_option("NAME", a.session, "letters, digits, - and _")->required();
  const auto add_pose = [&a](CLI::App& command) {
    return command
        .add_option("--pose", a.pose, "X Y THETA: about where the robot is, metres and radians in map")
        ->expected(3)
        ->check(number_from(-kFar_m, kFar_m));
  };
  auto* load = session->get_subcommand("load");
  auto* pose = add_pose(*load);
  add_pose(*session->get_subcommand("confirm"));
  load->add_flag("--search", a.search, "look for the robot in the whole map (so without --pose)")
      ->excludes(pose);
}

void add_lasers(CLI::App& cli, Arguments& a, int& status) {
  auto* laser = cli.add_subcommand("laser", "a scanner's own settings");
  laser->require_subcommand(1);
  add(*laser, "set-ip", "give a Hokuyo Ethernet scanner another address; not while it is in use", status,
      [&a] { return set_laser_ip(a); });
  auto* set = laser->get_subcommand("set-ip");
  set->add_option("AT", a.laser.address, "where it answers now: 192.168.0.10, or tcp:HOST:PORT")->required();
  set->add_option("NEW", a.laser.new_address, "its new address")->required();
  set->add_option("--netmask", a.laser.netmask, "of its network")->capture_default_str();
  set->add_option("--gateway", a.laser.gateway, "of its network (the new address with 1 at its end)");
  set->add_option("--serial", a.laser.serial_number, "serial number that it must report (any)");
  set->add_option("--wait", a.laser.patience_s, "seconds to wait for it at its new address; 0: do not")
      ->capture_default_str()
      ->check(number_from(0.0, 3600.0));
}

void add_missions(CLI::App& cli, Arguments& a, int& status) {
  add(cli, "start", "explore, and come home", status, [&a] { return show(a, "start", &nothing); });
  add(cli, "pause", "stand; the mission is kept", status, [&a] { return show(a, "pause", &nothing); });
  add(cli, "resume", "go on with the paused mission", status, [&a] { return show(a, "resume", &nothing); });
  add(cli, "home", "come back to the start", status, [&a] { return show(a, "home", &nothing); });
  add(cli, "goto", "go to a place of the map", status, [&a] {
    return show(a, "goto", &nothing, Json{{"x_m", a.x_m}, {"y_m", a.y_m}}, kSearchPatience);
  });
  auto* going = cli.get_subcommand("goto");
  going->add_option("X", a.x_m, "metres in map")->required()->check(number_from(-kFar_m, kFar_m));
  going->add_option("Y", a.y_m, "metres in map")->required()->check(number_from(-kFar_m, kFar_m));
  add(cli, "stop", "end the mission and the driving: the robot stands", status,
      [&a] { return a.all ? order_team(a, "stop") : show(a, "stop", &nothing); });
  cli.get_subcommand("stop")->add_flag("--all", a.all, "of the whole team, and name who was not reached");
  auto* wait = cli.add_subcommand("wait", "wait for something; --timeout S");
  wait->require_subcommand(1);
  wait->fallthrough();
  wait->add_option("--timeout", a.timeout_s, "seconds after which to give up (for ever)")
      ->check(number_from(0.0, 1e6));
  add(*wait, "done", "until the mission has ended: status 0 done, 5 failed or stopped", status,
      [&a] { return wait_done(a); });
  add(*wait, "ready", "until a mission would be taken", status, [&a] { return wait_ready(a); });
  for (auto* sub : wait->get_subcommands({})) sub->fallthrough();
}

int start(int argc, char** argv) {
  CLI::App cli(
      "The operator's command for topometricd.\n"
      "Exit status: 0 done, 1 refused or failed, 2 wrong command line, 3 no daemon, 4 not in time,\n"
      "5 the mission that was waited for failed or was stopped.");
  Arguments arguments;
  int status = kOk;
  cli.add_option("--socket", arguments.socket, "the daemon's control socket (control.socket)")
      ->capture_default_str();
  cli.add_flag("--json", arguments.json, "print the daemon's answer as JSON");
  cli.require_subcommand(1);
  cli.fallthrough();
  add_queries(cli, arguments, status);
  add_missions(cli, arguments, status);
  add_commands(cli, arguments, status);
  add_sessions(cli, arguments, status);
  add_lasers(cli, arguments, status);
  if (const auto ended = parse_command_line(cli, "topoctl", argc, argv)) return *ended;
  return status;
}

}  // namespace
}  // namespace topo::daemon

int main(int argc, char** argv) { return topo::io::run_program("topoctl", topo::daemon::start, argc, argv); }
