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

constexpr types::Duration kSavePatience = std::chrono::minutes(2);
constexpr types::Duration kSearchPatience = std::chrono::seconds(30);

// Bounds against typing errors; the daemon checks the actual limits.
constexpr double kFar_m = 1e6, kFast = 100.0;

std::string nothing(const Json&) { return {}; }

std::string member(const Json& answer, const char* name) {
  const auto found = answer.find(name);
  return found != answer.end() && found->is_string() ? found->get<std::string>() : std::string("-");
}

/// With --all: of the whole team.
int estop(const Arguments& arguments) {
  if (arguments.whom.all) return order_team(arguments, "estop");
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
  cli.get_subcommand("estop")->add_flag("--all", a.whom.all,
                                        "of the whole team, and name who was not reached");
  add(cli, "clear-estop", "let the robot move again", status,
      [&a] { return show(a, "clear_estop", &nothing); });
  auto* driving = cli.add_subcommand("drive", "drive by hand: with the keys, or at V m/s and W rad/s");
  auto* v = driving->add_option("V", a.drive.v_mps, "forward speed in m/s; without V and W the keys drive")
                ->check(number_from(-kFast, kFast));
  auto* w = driving->add_option("W", a.drive.omega_radps, "turning speed in rad/s, counter-clockwise")
                ->check(number_from(-kFast, kFast));
  v->needs(w);
  driving->add_option("--for", a.drive.seconds, "seconds (1), then stop")->check(number_from(0.0, 3600.0));
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

void add_areas(CLI::App& cli, Arguments& a, int& status) {
  auto* area = cli.add_subcommand("area", "areas that no wheel enters, or to go to first, of the whole team");
  area->require_subcommand(1);
  add(*area, "list", "those that are in force", status, [&a] { return show(a, "areas", &areas_table); });
  add(*area, "draw", "keep out of a polygon from now on, or go there first", status, [&a] {
    const auto told = [](const Json& answer) {
      return fmt::format("area {} is in force\n", member(answer, "id"));
    };
    const char* kind = a.area.first ? "here_first" : "keep_out";
    return show(a, "area.draw", told, Json{{"corners_m", a.area.corners}, {"kind", kind}});
  });
  area->get_subcommand("draw")
      ->add_option("CORNERS", a.area.corners, "X Y X Y X Y ...: metres in map, three corners and more")
      ->required()
      ->check(number_from(-kFar_m, kFar_m));
  area->get_subcommand("draw")->add_flag("--first", a.area.first,
                                         "goals in it come first, instead of keeping out");
  add(*area, "withdraw", "end the area ID: it may be entered again, or is like any other", status, [&a] {
    return show(a, "area.withdraw", &nothing, Json{{"id", a.what}});
  });
  area->get_subcommand("withdraw")->add_option("ID", a.what, "as topoctl area list shows it")->required();
}

void add_view(CLI::App& cli, Arguments& a, int& status) {
  auto* view = cli.add_subcommand("view", "the operator's page (topoview)");
  view->require_subcommand(1);
  add(*view, "pair", "make a token, with which a browser may give orders, as text and as a QR code", status,
      [&a] { return pair_browser(a); });
  auto* pair = view->get_subcommand("pair");
  pair->add_option("--config", a.view.config, "the daemon's configuration file")->capture_default_str();
  pair->add_option("--name", a.view.name, "what the token is called")->capture_default_str();
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

void add_setup(CLI::App& cli, Arguments& a, int& status) {
  add(cli, "setup", "find base and scanners, ask what only you know, and write the configuration", status,
      [&a] { return set_up(a); });
  auto* setup = cli.get_subcommand("setup");
  setup->add_option("--config", a.setup.config, "the file that is written; as it was, it is kept beside")
      ->capture_default_str();
  setup
      ->add_option("--serial", a.setup.serial,
                   "serial devices in place of the usual ones, * and ? as in a shell")
      ->type_name("PATTERN");
  setup->add_option("--tcp", a.setup.tcp, "scanners on Ethernet in place of 192.168.0.10 to .12")
      ->type_name("HOST[:PORT]");
  setup->add_option("--base", a.setup.bases, "further addresses of a base: tcp:HOST:PORT, can:INTERFACE:UNIT")
      ->type_name("ADDRESS");
  setup
      ->add_option("--countdown", a.setup.countdown_s,
                   "at a terminal: seconds to walk to where you shall stand")
      ->capture_default_str()
      ->check(number_from(0.0, 20.0));
}

void add_calibration(CLI::App& cli, Arguments& a, int& status) {
  add(cli, "wheels-up", "before the first drive, with the robot lifted: sense of both wheels, motors, stop",
      status, [&a] { return wheels_up(a); });
  add(cli, "calibrate", "wheels, delay and the scanners' places from a recorded drive of three minutes",
      status, [&a] { return calibrate_robot(a); });
  auto* calibrate = cli.get_subcommand("calibrate");
  calibrate->add_option("RECORDING", a.calibration.recording, "the daemon's recording of the drive")
      ->required();
  calibrate->add_option("--config", a.calibration.config, "the configuration that the drive was made with")
      ->required();
  calibrate->add_flag("--drive", a.calibration.drive,
                      "first drive eights in a circle of three metres, while the daemon records");
  calibrate->add_flag(
      "--write", a.calibration.write,
      "write what was found into the configuration, when it is believable; the old one is kept");
}

/// An order that a mate takes too.
void add_order(CLI::App& cli, Arguments& a, int& status, const char* name, const char* help) {
  add(cli, name, help, status, [&a, name] { return order(a, name); });
  auto* command = cli.get_subcommand(name);
  auto* all = command->add_flag("--all", a.whom.all, "of the whole team, and name who was not reached");
  command->add_option("--robot", a.whom.robot, "of that robot of the team, by its number (robot.id)")
      ->check(CLI::Range(1, 65535))
      ->excludes(all);
}

void add_missions(CLI::App& cli, Arguments& a, int& status) {
  add_order(cli, a, status, "start", "explore, and come home");
  add_order(cli, a, status, "pause", "stand; the mission is kept");
  add_order(cli, a, status, "resume", "go on with the paused mission");
  add_order(cli, a, status, "home", "come back to the start");
  add_order(cli, a, status, "stop", "end the mission and the driving: the robot stands");
  add(cli, "goto", "go to a place of the map", status, [&a] {
    return show(a, "goto", &nothing, Json{{"x_m", a.x_m}, {"y_m", a.y_m}}, kSearchPatience);
  });
  auto* going = cli.get_subcommand("goto");
  going->add_option("X", a.x_m, "metres in map")->required()->check(number_from(-kFar_m, kFar_m));
  going->add_option("Y", a.y_m, "metres in map")->required()->check(number_from(-kFar_m, kFar_m));
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
  add_areas(cli, arguments, status);
  add_lasers(cli, arguments, status);
  add_setup(cli, arguments, status);
  add_calibration(cli, arguments, status);
  add_view(cli, arguments, status);
  if (const auto ended = parse_command_line(cli, "topoctl", argc, argv)) return *ended;
  return status;
}

}  // namespace
}  // namespace topo::daemon

int main(int argc, char** argv) { return topo::io::run_program("topoctl", topo::daemon::start, argc, argv); }
