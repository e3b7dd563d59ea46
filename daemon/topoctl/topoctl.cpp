// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <signal.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <filesystem>
#include <thread>

#include "daemon/app/version.hpp"
#include "daemon/config/configuration.hpp"
#include "daemon/topoctl/client.hpp"
#include "daemon/topoctl/tables.hpp"
#include "drivers/io/posix.hpp"

namespace topo::daemon {
namespace {

// Exit statuses, as in topoctl(1).
constexpr int kOk = 0;
constexpr int kFailed = 1;
constexpr int kUsage = 2;
constexpr int kNoDaemon = 3;

constexpr types::Duration kPatience = std::chrono::seconds(5);
constexpr types::Duration kSavePatience = std::chrono::minutes(2);
constexpr types::Duration kDrivePeriod =
    std::chrono::milliseconds(100);  // the daemon's dead man waits 300 ms

std::atomic<bool> interrupted{false};

struct Arguments {
  std::string socket = ControlConfig{}.socket;
  bool json = false;
  std::string folder, level;
  double v_mps = 0.0, omega_radps = 0.0, seconds = 1.0;
};

int complain(const types::Error& error) {
  fmt::print(stderr, "topoctl: {}\n", error.message);
  return error.code == types::Errc::kNotFound ? kNoDaemon : kFailed;
}

types::Result<Json> ask(const Arguments& arguments, const char* method, const Json& params,
                        types::Duration patience = kPatience) {
  auto client = Client::connect(arguments.socket);
  if (!client) return tl::unexpected(client.error());
  auto answer = client->call(method, params, patience);
  // What the daemon refuses is no missing daemon, whatever its reason.
  if (!answer && answer.error().code == types::Errc::kNotFound)
    return types::fail(types::Errc::kIo, answer.error().message);
  return answer;
}

/// Asks, and prints the answer as JSON or through `table`.
int show(const Arguments& arguments, const char* method, std::string (*table)(const Json&),
         const Json& params = Json::object(), types::Duration patience = kPatience) {
  const auto answer = ask(arguments, method, params, patience);
  if (!answer) return complain(answer.error());
  if (arguments.json) {
    fmt::print("{}\n", answer->dump(2, ' ', false, Json::error_handler_t::replace));
  } else {
    fmt::print("{}", table(*answer));
  }
  return kOk;
}

std::string nothing(const Json&) { return {}; }

std::string member(const Json& answer, const char* name) {
  const auto found = answer.find(name);
  return found != answer.end() && found->is_string() ? found->get<std::string>() : std::string("-");
}

int save_map(const Arguments& arguments) {
  // The daemon has another working folder than the person who asks.
  std::error_code error;
  const auto folder = std::filesystem::absolute(arguments.folder, error).lexically_normal();
  if (error) return complain({types::Errc::kIo, error.message(), 0});
  const auto table = [](const Json& a) { return fmt::format("map saved to {}\n", member(a, "dir")); };
  return show(arguments, "map.save", table, Json{{"dir", folder.string()}}, kSavePatience);
}

/// Keeps telling the daemon, which stops by itself when we are gone.
int drive(const Arguments& arguments) {
  auto client = Client::connect(arguments.socket);
  if (!client) return complain(client.error());
  ::signal(SIGINT, [](int) { interrupted = true; });
  ::signal(SIGTERM, [](int) { interrupted = true; });
  const Json params{{"v_mps", arguments.v_mps}, {"omega_radps", arguments.omega_radps}};
  const types::Stamp end = io::monotonic_now() + types::from_seconds(arguments.seconds);
  while (!interrupted && io::monotonic_now() < end) {
    if (const auto answer = client->call("drive", params, kPatience); !answer)
      return complain(answer.error());
    std::this_thread::sleep_for(std::min(kDrivePeriod, end - io::monotonic_now()));
  }
  const auto stopped = client->call("stop", Json::object(), kPatience);
  return stopped ? kOk : complain(stopped.error());
}

/// One subcommand: its name, help and what it does.
void add(CLI::App& parent, const char* name, const char* help, int& status, std::function<int()> act) {
  parent.add_subcommand(name, help)->callback([&status, act = std::move(act)] { status = act(); });
}

void add_queries(CLI::App& cli, const Arguments& a, int& status) {
  add(cli, "status", "where the robot is and what it does", status,
      [&a] { return show(a, "status", &status_table); });
  add(cli, "health", "what is wrong, if anything", status, [&a] { return show(a, "health", &health_table); });
  add(cli, "latency", "wake-up latency and run time of the threads", status,
      [&a] { return show(a, "latency", &latency_table); });
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
      [&a] { return show(a, "estop", &nothing); });
  add(cli, "clear-estop", "let the robot move again", status,
      [&a] { return show(a, "clear_estop", &nothing); });
  add(cli, "stop", "end the driving", status, [&a] { return show(a, "stop", &nothing); });
  add(cli, "drive", "drive at V m/s and W rad/s (counter-clockwise), then stop", status,
      [&a] { return drive(a); });
  auto* driving = cli.get_subcommand("drive");
  driving->add_option("V", a.v_mps, "forward speed in m/s")->required();
  driving->add_option("W", a.omega_radps, "turning speed in rad/s")->required();
  driving->add_option("--for", a.seconds, "seconds (1)")->check(CLI::Range(0.0, 3600.0));
  add(cli, "log-level", "the least important message still logged", status, [&a] {
    return show(a, "log_level", &nothing, Json{{"level", a.level}});
  });
  cli.get_subcommand("log-level")
      ->add_option("LEVEL", a.level, "trace, debug, info, warning or error")
      ->required();
  auto* map = cli.add_subcommand("map", "the map");
  map->require_subcommand(1);
  add(*map, "save", "write map.pgm, map.yaml and cloud.ply into DIR", status, [&a] { return save_map(a); });
  map->get_subcommand("save")
      ->add_option("DIR", a.folder, "an existing folder that the daemon may write to")
      ->required();
}

int start(int argc, char** argv) {
  CLI::App cli(
      "The operator's command for topometricd.\n"
      "Exit status: 0 done, 1 refused or failed, 2 wrong command line, 3 no daemon.");
  Arguments arguments;
  int status = kOk;
  cli.add_option("--socket", arguments.socket, "the daemon's control socket (control.socket)")
      ->capture_default_str();
  cli.add_flag("--json", arguments.json, "print the daemon's answer as JSON");
  cli.require_subcommand(1);
  cli.fallthrough();
  add_queries(cli, arguments, status);
  add_commands(cli, arguments, status);
  try {
    cli.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return cli.exit(error) == 0 ? kOk : kUsage;
  }
  return status;
}

}  // namespace
}  // namespace topo::daemon

int main(int argc, char** argv) { return topo::daemon::start(argc, argv); }
