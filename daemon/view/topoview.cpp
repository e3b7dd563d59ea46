// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// The operator's page (topoview(8)): a process of its own, so that no browser is anything to the daemon.
#include <fmt/format.h>
#include <signal.h>

#include <cstdio>
#include <functional>

#include "daemon/app/command_line.hpp"
#include "daemon/app/logging.hpp"
#include "daemon/config/load.hpp"
#include "daemon/view/serve.hpp"
#include "daemon/view/token_commands.hpp"
#include "drivers/io/run_program.hpp"

namespace topo::daemon {
namespace {

// Exit statuses, as in topoview(8).
constexpr int kOk = 0;
constexpr int kFailed = 1;
constexpr int kUsersFault = 2;

int complain(const std::string& message, int status) {
  static_cast<void>(std::fputs(("topoview: " + message + "\n").c_str(), stderr));
  return status;
}

int end(const types::Status& done) { return done ? kOk : complain(done.error().message, kFailed); }

/// What is done, on this thread, until it is to end.
int serve(const Configuration& configuration,
          const std::function<types::Status(const Configuration&)>& what) {
  sigset_t ending;
  ::sigemptyset(&ending);
  for (const int signal : {SIGTERM, SIGINT, SIGHUP}) ::sigaddset(&ending, signal);
  ::pthread_sigmask(SIG_BLOCK, &ending, nullptr);  // in the log's thread for ever
  ::signal(SIGPIPE, SIG_IGN);
  if (const auto logging = start_logging({configuration.log.level, {}}); !logging)
    return complain(logging.error().message, kFailed);
  ::pthread_sigmask(SIG_UNBLOCK, &ending, nullptr);
  const types::Status served = what(configuration);
  end_logging();
  return end(served);
}

/// What a subcommand does with the configuration; nothing was said: serve.
using Deed = std::function<int(const Configuration&)>;

int start(int argc, char** argv) {
  CLI::App cli(
      "Serves the operator's page: the map, the robots, what they mean to do and why, and a stop for all.\n"
      "Exit status: 0 stopped in order or done; 1 failed; 2 wrong configuration or command line.");
  std::string config, name = "browser", replay;
  int port = 0;
  bool check = false;
  Deed deed = [&](const Configuration& c) {
    if (replay.empty()) return serve(c, &serve_view);
    return serve(c, [&](const Configuration& same) { return serve_replay(same, config, replay); });
  };
  cli.add_option("--config", config, "the daemon's configuration file, section [view]")->required();
  cli.add_flag("--check", check, "check the configuration, and exit");
  auto* again = cli.add_option("--replay", replay,
                               "show a mission again: a session, a folder's newest journal, or a recording");
  cli.add_option("--port", port, "of the replay's page, instead of view.port")
      ->needs(again)
      ->check(CLI::Range(1, 65535));
  auto* pair = cli.add_subcommand("pair", "make a token, with which a browser may give orders, and print it");
  pair->add_option("--name", name, "what it is called: 1 to 32 letters, digits, - and _")
      ->capture_default_str();
  pair->callback([&] { deed = [&](const Configuration& c) { return end(pair_browser(c.view, name)); }; });
  cli.add_subcommand("tokens", "the tokens there are")->callback([&] {
    deed = [](const Configuration& c) { return end(list_tokens(c.view)); };
  });
  auto* revoke = cli.add_subcommand("revoke", "end a token: at once, also where it is in use");
  revoke->add_option("NAME", name, "as topoview tokens shows it")->required();
  revoke->callback([&] { deed = [&](const Configuration& c) { return end(revoke_token(c.view, name)); }; });
  cli.require_subcommand(0, 1);
  cli.fallthrough();
  if (const auto ended = parse_command_line(cli, "topoview", argc, argv)) return *ended;
  auto loaded = load_configuration(config);
  if (!loaded) return complain(loaded.error().message, kUsersFault);
  if (!loaded->faults.empty()) {
    static_cast<void>(std::fputs(faults_text(*loaded).c_str(), stderr));
    return kUsersFault;
  }
  if (check) {
    fmt::print("topoview: {}: {} port {}: no faults\n", config, loaded->values.view.address,
               loaded->values.view.port);
    return kOk;
  }
  if (port != 0) loaded->values.view.port = port;
  return deed(loaded->values);
}

}  // namespace
}  // namespace topo::daemon

int main(int argc, char** argv) { return topo::io::run_program("topoview", topo::daemon::start, argc, argv); }
