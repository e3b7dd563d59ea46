// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// Run by the service manager after the daemon has stopped for any reason (systemd/topometric.service).
#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "daemon/app/command_line.hpp"
#include "daemon/config/load.hpp"
#include "daemon/control/probe.hpp"
#include "daemon/estop/latch_file.hpp"
#include "daemon/estop/stop_robot.hpp"
#include "daemon/estop/watch_robot.hpp"
#include "drivers/io/run_program.hpp"
#include "drivers/pioneer/base_connector.hpp"

namespace topo::daemon {
namespace {

// Exit statuses, as in topometric-estop(8).
constexpr int kOk = 0;
constexpr int kFailed = 1;
constexpr int kUsersFault = 2;
constexpr int kDaemonLives = 3;

/// Limit for a daemon's answer; its main loop never runs that long without a pause.
constexpr types::Duration kPatience = std::chrono::milliseconds(200);

/// stop_robot() is bounded, but the resolution of a host name is not: SIGALRM ends the process then.
constexpr unsigned kHardLimit_s = 2;

/// Unlike fmt::print() it does not throw when standard error cannot be written: the robot must be stopped
/// anyway.
void tell(const std::string& message) {
  static_cast<void>(std::fputs(("topometric-estop: " + message + "\n").c_str(), stderr));
}

int complain(const std::string& message, int status) {
  tell(message);
  return status;
}

int stop(const std::string& address) {
  auto connector = pioneer::make_base_connector(address);
  if (!connector) return complain(connector.error().message, kUsersFault);
  const auto outcome = stop_robot(**connector);
  if (!outcome) return complain(outcome.error().message, kFailed);
  if (*outcome == StopOutcome::kMoves) {
    return complain(fmt::format("{}: E_STOP, VEL 0, RVEL 0 and CLOSE written, but the wheels still turned at "
                                "the last report",
                                address),
                    kFailed);
  }
  const char* seen = *outcome == StopOutcome::kStands ? "the robot stands" : "the robot reports nothing";
  fmt::print("topometric-estop: {}: E_STOP, VEL 0, RVEL 0, CLOSE written; {}\n", address, seen);
  return kOk;
}

/// The robot did not obey: every byte would feed its watchdog, which is what stops it.
int watch(const std::string& address, const std::string& why) {
  tell(
      fmt::format("{}: nothing is written, because the robot did not obey ({}) and its own watchdog stops "
                  "it; press its stop button when it does not",
                  address, why));
  auto connector = pioneer::make_base_connector(address);
  if (!connector) return complain(connector.error().message, kUsersFault);
  const auto outcome = watch_robot(**connector);
  if (!outcome) return complain(outcome.error().message, kFailed);
  if (*outcome == StopOutcome::kMoves)
    return complain(fmt::format("{}: the wheels still turned at the last report", address), kFailed);
  tell(*outcome == StopOutcome::kStands ? "the robot stands" : "the robot reports nothing");
  return kOk;
}

/// What the daemon left behind decides: a robot that did not obey gets no byte.
int stop_or_watch(const Configuration& configuration) {
  const std::string& folder = configuration.control.state_folder;
  const FoundLatch silence = folder.empty() ? FoundLatch{} : read_latch(silence_path(folder));
  if (silence.latched) return watch(configuration.base.address, silence.text);
  return stop(configuration.base.address);
}

/// A daemon that hangs may hold the port exclusively: always a serial port, and often a TCP bridge.
int stop_beside(const std::string& socket, pid_t daemon, const Configuration& configuration, bool force) {
  tell(fmt::format("the daemon on {}{} does not answer", socket,
                   daemon > 0 ? fmt::format(" (process {})", daemon) : ""));
  if (force && (daemon <= 0 || ::kill(daemon, SIGKILL) != 0))
    tell(fmt::format("it cannot be ended: {}",
                     daemon <= 0 ? "its process is not known" : std::strerror(errno)));
  const int status = stop_or_watch(configuration);
  if (status != kOk && !force) tell("it may hold the port; --force ends it first");
  return status;
}

int stop_configured(const std::string& file, bool force) {
  const auto loaded = load_configuration(file);
  if (!loaded) return complain(loaded.error().message, kUsersFault);
  if (!loaded->faults.empty()) {
    static_cast<void>(std::fputs(faults_text(*loaded).c_str(), stderr));
    return kUsersFault;
  }
  // A port must have one master: two writers make the robot jerk.
  const std::string& socket = loaded->values.control.socket;
  const Probe daemon = probe(socket, kPatience);
  if (daemon.served == Served::kByLiving) {
    return complain(fmt::format("a daemon serves this robot on {}; use topoctl estop", socket), kDaemonLives);
  }
  if (daemon.served == Served::kNobody) return stop_or_watch(loaded->values);
  return stop_beside(socket, daemon.pid, loaded->values, force);
}

int start(int argc, char** argv) {
  CLI::App cli(
      "Stops a robot whose daemon is gone: writes E_STOP, VEL 0, RVEL 0 and CLOSE to its port, in less than "
      "a second.\n"
      "Exit status: 0 written, 1 failed or the robot still moves, 2 wrong configuration or command line, 3 a "
      "daemon is running.");
  std::string config, address;
  auto* from_file = cli.add_option("--config", config, "the daemon's configuration file");
  cli.add_option("--address", address,
                 "the base's address: serial:/dev/NAME, tcp:HOST:PORT or can:INTERFACE:UNIT")
      ->excludes(from_file);
  bool force = false;
  cli.add_flag("--force", force, "end (SIGKILL) a daemon that does not answer, which may hold the port")
      ->needs(from_file);
  if (const auto ended = parse_command_line(cli, "topometric-estop", argc, argv)) return *ended;
  if (config.empty() && address.empty())
    return complain("--config FILE or --address ADDRESS is missing (--help tells more)", kUsersFault);
  ::signal(SIGPIPE, SIG_IGN);  // for the same reason as in tell()
  ::alarm(kHardLimit_s);
  return config.empty() ? stop(address) : stop_configured(config, force);
}

}  // namespace
}  // namespace topo::daemon

int main(int argc, char** argv) {
  return topo::io::run_program("topometric-estop", topo::daemon::start, argc, argv);
}
