// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// toposim: a simulated building with robots behind the real wire protocols.
#include <sys/prctl.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "drivers/io/run_program.hpp"
#include "tests/sim/devices/commands.hpp"
#include "tests/sim/devices/sim_rig.hpp"
#include "tests/sim/team_start.hpp"

namespace {

using namespace topo;
using nlohmann::json;

constexpr int kUserFault = 2;
constexpr int kFailure = 1;
constexpr std::uint16_t kScipPort = 10940;
constexpr std::uint16_t kArcosPort = 8101;

volatile std::sig_atomic_t stop_asked = 0;

struct Options {
  std::string world;
  int robots = 1;
  std::string model = "p3dx";
  std::uint64_t seed = 1;
  bool tcp = false;
  std::string pty_folder;
  std::string can_interface;
  std::string ports = "any";
  std::string laser;
  std::vector<double> starts;
  std::array<int, sim::kDeviceCount> tcp_ports{-1, -1, -1};
  std::array<std::string, sim::kDeviceCount> pty_links;
  std::string control;
  std::string truth;
  std::string difficulty = "fixed";
  std::vector<double> front_mount;
  bool front_upside_down = false;
  double coronal_roll_deg = 0.0;
  bool coronal_backward = false;
  std::optional<double> wheel_error, track_error;
  int watchdog_ms = 2000;
  double battery_volts = 12.7;
  bool die_with_parent = false;
  std::string ctl_socket;
  std::vector<std::string> ctl_words;
};

int complain(const std::string& text, int status) {
  std::cerr << "toposim: " << text << "\n";
  return status;
}

int complain(const types::Error& error) {
  const bool user = error.code == types::Errc::kInvalidInput || error.code == types::Errc::kNotFound ||
                    error.code == types::Errc::kPermission || error.code == types::Errc::kBusy;
  return complain(error.message, user ? kUserFault : kFailure);
}

std::string description() {
  return "toposim - a simulated building with robots behind the real wire protocols\n\n"
         "DESCRIPTION\n"
         "Puts Pioneer robots with two Hokuyo scanners each (one level, one coronal) into a building and "
         "runs it in\n"
         "real time. The scanners speak SCIP and the bases ARCOS, over TCP or pseudo terminals, as the real "
         "ones do.\n"
         "When all devices answer, one JSON line with their addresses is printed on standard output. How "
         "hard the\n"
         "simulation is on the robot is fixed and is part of that line and of every report.\n"
         "SIGTERM and SIGINT end it.";
}

std::string footer() {
  return "FAULTS AND TRUTH\n"
         "toposim ctl SOCKET COMMAND [KEY=VALUE ...] sends a command to a running simulation and prints its "
         "answer; the\n"
         "socket takes the same as JSON, one object a line: "
         "{\"command\":\"cut\",\"device\":\"front\",\"seconds\":2}.\n"
         "device is front, coronal or base; robot=N says whose (0 when left out). Angles are in degrees, "
         "counter-clockwise\n"
         "from straight ahead. A fault lasts until it is ended as its line says, or for its seconds. "
         "Commands:\n" +
         sim::command_help() +
         "\nFILES\n"
         "The world is a map_server YAML with its image or a drawn scene (.toml); config/worlds documents "
         "its keys.\n"
         "The truth file holds t, x, y, theta every 100 ms, tab-separated, t on CLOCK_MONOTONIC.\n\n"
         "EXIT STATUS\n"
         "0 after SIGTERM or SIGINT, 2 for wrong options or a wrong world, 1 for other failures.";
}

void add_link_options(CLI::App& app, Options& o) {
  for (std::size_t d = 0; d < sim::kDeviceCount; ++d) {
    const std::string name(sim::kDeviceNames[d]);
    auto* port =
        app.add_option("--" + name + "-tcp", o.tcp_ports[d], "TCP port of robot 0's " + name + " (0: any)");
    port->check(CLI::Range(0, 65535))->type_name("PORT");
    app.add_option("--" + name + "-pty", o.pty_links[d], "link to a terminal for robot 0's " + name)
        ->type_name("PATH")
        ->excludes(port);
  }
}

void add_options(CLI::App& app, Options& o) {
  app.add_option("--world", o.world, "the building")->type_name("FILE");
  app.add_option("--robots", o.robots, "how many robots")->check(CLI::Range(1, 32))->capture_default_str();
  app.add_option("--model", o.model, "p3dx or p3at")
      ->check(CLI::IsMember({"p3dx", "p3at"}))
      ->capture_default_str();
  app.add_option("--seed", o.seed, "the same seed gives the same noise")->capture_default_str();
  auto* tcp = app.add_flag("--tcp", o.tcp, "all devices on TCP ports of 127.0.0.1 (default)");
  app.add_option(
         "--pty", o.pty_folder,
         "all devices on pseudo terminals: links laser_front, laser_coronal and base in DIR, of more robots "
         "than one in DIR/robot0, DIR/robot1, ...")
      ->type_name("DIR")
      ->excludes(tcp);
  app.add_option("--can", o.can_interface,
                 "the bases on a CAN interface, robot 0 as unit 0, robot 1 as unit 1, ...; the scanners stay")
      ->type_name("IFACE");
  app.add_option("--ports", o.ports,
                 "any, or standard: 10940, 10941 and 8101 for robot 0, ten more for each further robot")
      ->check(CLI::IsMember({"any", "standard"}))
      ->capture_default_str();
  app.add_option("--start", o.starts,
                 "start of a robot, m and rad; once a robot; else the world's, or around the first")
      ->type_name("X Y THETA")
      ->check([](const std::string& text) {
        double value = 0.0;
        const bool number = CLI::detail::lexical_cast(text, value) && std::isfinite(value);
        return number ? std::string() : "found " + text + ", expected a finite number";
      })
      ->type_size(3)
      ->expected(1, 32);
  app.add_option("--laser", o.laser,
                 "model of both scanners: " + sim::scip_model_names() +
                     " (UTM-30LX-EW over TCP, UTM-30LX over terminals)")
      ->type_name("MODEL");
  add_link_options(app, o);
  app.add_option("--watchdog-ms", o.watchdog_ms, "the firmware's watchdog; 0: none")
      ->check(CLI::Range(0, 65535))
      ->capture_default_str();
  app.add_option("--battery", o.battery_volts, "battery voltage")
      ->check(CLI::Range(0.0, 60.0))
      ->capture_default_str();
  app.add_option("--difficulty", o.difficulty,
                 "fixed, or none for tests of geometry (reports say that it was changed)")
      ->check(CLI::IsMember({"fixed", "none"}))
      ->capture_default_str();
  app.add_option("--control", o.control, "Unix socket for faults on command and the truth")
      ->type_name("SOCKET");
  app.add_option("--truth", o.truth, "file for the true way of the robot (FILE.0, FILE.1, ... of several)")
      ->type_name("FILE");
  app.add_flag("--die-with-parent", o.die_with_parent, "end when the process that started this one ends");
  auto* ctl = app.add_subcommand("ctl", "send a command to a running simulation (see below)");
  ctl->add_option("SOCKET", o.ctl_socket, "its --control socket")->required();
  ctl->add_option("COMMAND", o.ctl_words, "name and KEY=VALUE arguments")->required()->expected(1, 32);
}

/// A robot that is not as its configuration says.
void add_mount_options(CLI::App& app, Options& o) {
  app.add_option("--front-mount", o.front_mount,
                 "place of the front scanners from the centre, m, and yaw in degrees (0.021 0 0)")
      ->type_name("X Y DEG")
      ->check(CLI::Range(-360.0, 360.0))
      ->type_size(3);
  app.add_flag("--front-upside-down", o.front_upside_down, "the front scanners' beams run clockwise");
  app.add_option("--coronal-roll", o.coronal_roll_deg,
                 "turn of the coronal scanners' zero beam from up, degrees")
      ->type_name("DEG")
      ->check(CLI::Range(-360.0, 360.0));
  app.add_flag("--coronal-backward", o.coronal_backward,
               "the coronal scanners' beams run from left to right");
  app.add_option("--wheel-error", o.wheel_error, "of each wheel's travel, signs by the seed (0.02)")
      ->type_name("SHARE")
      ->check(CLI::Range(0.0, 0.2));
  app.add_option("--track-error", o.track_error, "of the track, sign by the seed (0.05)")
      ->type_name("SHARE")
      ->check(CLI::Range(0.0, 0.2));
}

void mount_scanners(const Options& o, sim::RobotConfig& robot) {
  if (o.front_mount.size() == 3) {
    robot.front_mount.x_m = o.front_mount[0];
    robot.front_mount.y_m = o.front_mount[1];
    robot.front_mount.yaw_rad = o.front_mount[2] * types::kDegree_rad;
  }
  robot.front_mount.mirrored = o.front_upside_down;
  robot.coronal_mount.roll_rad = o.coronal_roll_deg * types::kDegree_rad;
  robot.coronal_mount.mirrored = o.coronal_backward;
}

types::Result<sim::RobotConfig> robot_config(const Options& o, std::size_t i) {
  namespace fs = std::filesystem;
  fs::path folder = o.pty_folder;
  if (!o.pty_folder.empty() && o.robots > 1) folder /= "robot" + std::to_string(i);
  sim::RobotConfig robot = o.pty_folder.empty() ? sim::tcp_robot() : sim::pty_robot(folder);
  robot.model = o.model;
  robot.watchdog_ms = o.watchdog_ms;
  robot.battery_volts = o.battery_volts;
  mount_scanners(o, robot);
  if (o.starts.size() >= 3 * (i + 1))
    robot.start = {o.starts[3 * i], o.starts[3 * i + 1], o.starts[3 * i + 2]};
  if (o.pty_folder.empty() && o.ports == "standard") {
    const auto offset = static_cast<std::uint16_t>(10 * i);
    robot.links[0].tcp_port = static_cast<std::uint16_t>(kScipPort + offset);
    robot.links[1].tcp_port = static_cast<std::uint16_t>(kScipPort + 1 + offset);
    robot.links[2].tcp_port = static_cast<std::uint16_t>(kArcosPort + offset);
  }
  for (std::size_t d = 0; i == 0 && d < sim::kDeviceCount; ++d) {
    if (o.tcp_ports[d] >= 0) robot.links[d] = {static_cast<std::uint16_t>(o.tcp_ports[d]), {}};
    if (!o.pty_links[d].empty()) robot.links[d] = {std::nullopt, o.pty_links[d]};
  }
  if (!o.can_interface.empty()) {
    sim::LinkConfig& link = robot.links[static_cast<std::size_t>(sim::DeviceId::kBase)];
    link.can_interface = o.can_interface;
    link.can_unit = static_cast<int>(i);
  }
  // On a terminal, the sensor is the USB model.
  const auto usual = [&robot](std::size_t d) {
    return robot.links[d].tcp_port ? sim::ScipModel::kUtm30LxEw : sim::ScipModel::kUtm30Lx;
  };
  robot.front = usual(0);
  robot.coronal = usual(1);
  if (!o.laser.empty()) {
    const auto model = sim::find_scip_model(o.laser);
    if (!model) {
      return types::fail(types::Errc::kInvalidInput,
                         "--laser: no model \"" + o.laser + "\", expected one of " + sim::scip_model_names());
    }
    robot.front = robot.coronal = *model;
  }
  return robot;
}

types::Status make_pty_folders(const sim::RobotConfig& robot) {
  for (const sim::LinkConfig& link : robot.links) {
    const auto folder = link.pty_link.parent_path();
    std::error_code error;
    if (link.tcp_port || !link.can_interface.empty() || folder.empty()) continue;
    std::filesystem::create_directories(folder, error);
    if (error) {
      return types::fail(types::Errc::kInvalidInput,
                         folder.string() + ": cannot make the folder: " + error.message());
    }
  }
  return {};
}

types::Result<sim::RigConfig> rig_config(const Options& o) {
  sim::RigConfig config;
  config.seed = o.seed;
  config.truth_file = o.truth;
  config.control_socket = o.control;
  if (o.difficulty == "none") config.difficulty = sim::Difficulty::none();
  if (o.wheel_error) config.difficulty.wheel_scale_error = *o.wheel_error;
  if (o.track_error) config.difficulty.track_error = *o.track_error;
  for (std::size_t i = 0; i < static_cast<std::size_t>(o.robots); ++i) {
    auto robot = robot_config(o, i);
    if (!robot.has_value()) return tl::unexpected(robot.error());
    if (auto status = make_pty_folders(*robot); !status.has_value()) return tl::unexpected(status.error());
    config.robots.push_back(std::move(*robot));
  }
  return config;
}

/// Robots for which neither the command line nor the world has a start stand around the first.
types::Status place_the_others(const sim::World& world, sim::RigConfig& config) {
  const auto named = world.start_poses();
  if (named.empty() || config.robots.size() <= named.size()) return {};
  const bool all_given =
      std::ranges::all_of(config.robots, [](const auto& robot) { return robot.start.has_value(); });
  if (all_given) return {};
  const sim::Se2 first = config.robots.front().start.value_or(named.front());
  const auto starts = sim::team_starts(world, first, static_cast<int>(config.robots.size()));
  if (!starts) return tl::unexpected(starts.error());
  for (std::size_t i = 0; i < config.robots.size(); ++i)
    if (!config.robots[i].start) config.robots[i].start = (*starts)[i];
  return {};
}

json address_json(const sim::DeviceAddress& address) {
  if (!address.interface.empty())
    return {{"transport", "can"},
            {"interface", address.interface},
            {"unit", address.unit},
            {"address", "can:" + address.interface + ":" + std::to_string(address.unit)}};
  if (!address.tcp)
    return {{"transport", "pty"},
            {"path", address.path.string()},
            {"address", "serial:" + address.path.string()}};
  return {{"transport", "tcp"},
          {"host", address.host},
          {"port", address.port},
          {"address", "tcp:" + address.host + ":" + std::to_string(address.port)}};
}

void announce(sim::SimRig& rig, const Options& o) {
  json robots = json::array();
  for (std::size_t i = 0; i < rig.robot_count(); ++i) {
    sim::RobotRig& robot = rig.robot(i);
    json entry{{"model", robot.config().model}};
    const sim::Truth truth = rig.truth(i);
    entry["start"] = {truth.pose.x_m, truth.pose.y_m, truth.pose.theta_rad};
    for (std::size_t d = 0; d < sim::kDeviceCount; ++d) {
      const auto id = static_cast<sim::DeviceId>(d);
      json device = address_json(robot.wire(id).address());
      if (id != sim::DeviceId::kBase) {
        device["model"] = robot.laser(id).model().name;
        device["serial_number"] = robot.laser_serial(id);
      }
      entry[std::string(sim::kDeviceNames[d])] = std::move(device);
    }
    robots.push_back(std::move(entry));
  }
  const json line{{"ready", true},
                  {"world", o.world},
                  {"seed", o.seed},
                  {"control", o.control},
                  {"epoch_s", rig.epoch_s()},
                  {"difficulty", rig.config().difficulty.text()},
                  {"robots", std::move(robots)}};
  std::cout << line.dump() << std::endl;
}

/// Sends KEY=VALUE words as a JSON object: numbers and true/false as such, all others as text.
int run_ctl(const Options& o) {
  json request{{"command", o.ctl_words[0]}};
  for (std::size_t i = 1; i < o.ctl_words.size(); ++i) {
    const std::string& word = o.ctl_words[i];
    const auto equals = word.find('=');
    if (equals == std::string::npos) return complain("ctl: \"" + word + "\", expected KEY=VALUE", kUserFault);
    const std::string text = word.substr(equals + 1);
    json value = json::parse(text, nullptr, false);
    request[word.substr(0, equals)] = value.is_number() || value.is_boolean() ? value : json(text);
  }
  constexpr int kTimeout_ms = 5000;
  const auto answer = sim::ask_control(o.ctl_socket, request.dump(), kTimeout_ms);
  if (!answer.has_value()) return complain(answer.error());
  const json parsed = json::parse(*answer, nullptr, false);
  if (parsed.is_object() && parsed.value("ok", false)) {
    std::cout << *answer << std::endl;
    return 0;
  }
  return complain(parsed.is_object() ? parsed.value("error", *answer) : *answer, kUserFault);
}

void install_signals() {
  struct sigaction action {};
  action.sa_handler = [](int) { stop_asked = 1; };
  sigaction(SIGTERM, &action, nullptr);
  sigaction(SIGINT, &action, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
}

int run_simulation(const Options& o) {
  if (o.world.empty()) return complain("--world FILE is missing; toposim --help explains", kUserFault);
  if (o.starts.size() > 3 * static_cast<std::size_t>(o.robots)) {
    return complain("more --start than --robots", kUserFault);
  }
  constexpr int kCanUnits = 8;
  if (!o.can_interface.empty() && o.robots > kCanUnits)
    return complain("--can: a bus has 8 units, and no more robots", kUserFault);
  install_signals();
  const pid_t parent = ::getppid();
  if (o.die_with_parent && (::prctl(PR_SET_PDEATHSIG, SIGTERM) != 0 || ::getppid() != parent))
    return kFailure;
  auto world = sim::World::load(o.world);
  if (!world.has_value()) return complain(world.error());
  auto config = rig_config(o);
  if (!config.has_value()) return complain(config.error());
  if (auto placed = place_the_others(*world, *config); !placed) return complain(placed.error());
  auto rig = sim::SimRig::create(std::move(*world), *config);
  if (!rig.has_value()) return complain(rig.error());
  announce(**rig, o);
  while (stop_asked == 0) (*rig)->iterate();
  std::cerr << "toposim: " << sim::seconds_of((*rig)->now()) << " s simulated, " << (*rig)->overruns()
            << " overruns, " << (*rig)->lost_s() << " s lost; " << config->difficulty.text() << "\n";
  return 0;
}

int start(int argc, char** argv) {
  Options options;
  CLI::App app(description(), "toposim");
  app.footer(footer());
  app.set_version_flag("--version", "toposim " TOPO_VERSION, "print the version and exit");
  add_options(app, options);
  add_mount_options(app, options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kUserFault;
  }
  return app.got_subcommand("ctl") ? run_ctl(options) : run_simulation(options);
}

}  // namespace

int main(int argc, char** argv) { return topo::io::run_program("toposim", start, argc, argv); }
