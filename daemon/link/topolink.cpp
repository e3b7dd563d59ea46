// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// The carrier of a team's datagrams (topolink(8)): a process of its own, because DDS may block or hang.
#include <fmt/format.h>
#include <signal.h>
#include <spdlog/spdlog.h>
#include <systemd/sd-daemon.h>
#include <unistd.h>

#include <cstdio>
#include <ctime>

#include "daemon/app/command_line.hpp"
#include "daemon/app/logging.hpp"
#include "daemon/config/load.hpp"
#include "daemon/link/dds_log.hpp"
#include "daemon/link/link_loop.hpp"
#include "daemon/link/team_credentials.hpp"
#include "drivers/io/run_program.hpp"

namespace topo::daemon {
namespace {

// Exit statuses, as in topolink(8).
constexpr int kOk = 0;
constexpr int kFailed = 1;
constexpr int kUsersFault = 2;

int complain(const std::string& message, int status) {
  static_cast<void>(std::fputs(("topolink: " + message + "\n").c_str(), stderr));
  return status;
}

/// Nothing: the configuration is without fault. Otherwise the exit status.
std::optional<int> load(const std::string& file, LoadedConfiguration& loaded) {
  auto read = load_configuration(file);
  if (!read) return complain(read.error().message, kUsersFault);
  loaded = std::move(*read);
  if (loaded.faults.empty()) return {};
  static_cast<void>(std::fputs(faults_text(loaded).c_str(), stderr));
  return kUsersFault;
}

void block_ending_signals() {
  sigset_t ending;
  ::sigemptyset(&ending);
  for (const int signal : {SIGTERM, SIGINT, SIGHUP}) ::sigaddset(&ending, signal);
  ::pthread_sigmask(SIG_BLOCK, &ending, nullptr);
}

/// The same program in the same process, whatever its threads hang in; the daemon's connection goes along.
int begin_anew(const std::string& config, const Carried& carried) {
  const std::string text = carried_text(carried);
  end_log_of_dds();
  end_logging();
  ::execl("/proc/self/exe", "topolink", "--config", config.c_str(), "--anew", text.c_str(), nullptr);
  return complain("cannot begin anew; the service manager starts it again", kFailed);
}

/// Does not return to main when it ends well: destructors of libraries would wait for threads that hang in
/// DDS.
[[noreturn]] void leave(int status) {
  end_log_of_dds();
  end_logging();
  std::fflush(nullptr);
  ::_exit(status);
}

int serve(const TeamConfig& team, const LogConfig& log, const std::string& config, const Carried& carried) {
  block_ending_signals();
  if (const auto logging = start_logging({log.level, {}}); !logging)
    return complain(logging.error().message, kFailed);
  if (!team.secure() && carried.daemon_fd < 0)
    spdlog::warn("team.security is \"off\": who is in reach of {} can read, disturb and command the team",
                 team.interface);
  auto loop = LinkLoop::make(team, carried);
  if (!loop) {
    end_logging();
    return complain(loop.error().message, kFailed);
  }
  if ((*loop)->run() == LinkLoop::End::kAnew) return begin_anew(config, (*loop)->carried());
  leave(kOk);
}

int start(int argc, char** argv) {
  CLI::App cli(
      "Carries a robot's datagrams to the other robots of its team, over DDS.\n"
      "Exit status: 0 stopped in order, or the configuration has no team; 1 failed; 2 wrong configuration, "
      "credentials or "
      "command line.");
  std::string config, anew;
  bool check = false;
  cli.add_option("--config", config, "the daemon's configuration file, section [team]")->required();
  cli.add_flag("--check", check, "check the configuration and the credentials, and exit");
  cli.add_option("--anew", anew, "")->group("");  // by the program itself
  if (const auto ended = parse_command_line(cli, "topolink", argc, argv)) return *ended;
  LoadedConfiguration loaded;
  if (const auto status = load(config, loaded)) return *status;
  const TeamConfig& team = loaded.values.team;
  if (!team.present) {
    fmt::print("topolink: {}: no section [team], so there is nothing to do\n", config);
    static_cast<void>(
        ::sd_notify(0, "READY=1\nSTATUS=no team is configured"));  // ended well, and not too early
    return kOk;
  }
  if (team.secure()) {
    if (const auto checked = check_credentials(team.security, team.name, team.id, std::time(nullptr));
        !checked)
      return complain(checked.error().message, kUsersFault);
  }
  if (check) {
    fmt::print("topolink: {}: team {}, robot {}, security {}: no faults\n", config, team.name, team.id,
               team.security);
    return kOk;
  }
  return serve(team, loaded.values.log, config, parse_carried(anew));
}

}  // namespace
}  // namespace topo::daemon

int main(int argc, char** argv) { return topo::io::run_program("topolink", topo::daemon::start, argc, argv); }
