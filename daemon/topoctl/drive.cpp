// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>

#include "daemon/topoctl/commands.hpp"
#include "daemon/topoctl/tables.hpp"
#include "daemon/topoctl/terminal.hpp"
#include "drivers/io/posix.hpp"

namespace topo::daemon {
namespace {

constexpr types::Duration kPeriod = std::chrono::milliseconds(100);  // the daemon's dead-man time is 300 ms
// A held key repeats after up to half a second at first, then faster.
constexpr types::Duration kKeyHolds = std::chrono::milliseconds(500);

/// Must be repeated: the daemon stops the robot when the client is gone.
types::Status tell(Client& client, const types::Twist2& twist) {
  const Json params{{"v_mps", twist.v_mps}, {"omega_radps", twist.omega_radps}};
  const auto answer = client.call("drive", params, kPatience);
  if (!answer) return tl::unexpected(answer.error());
  return {};
}

/// The last key pressed, if any; waits up to one period for it.
std::optional<Key> wait_for_key() {
  if (io::wait_for(STDIN_FILENO, POLLIN, kPeriod) <= 0) return {};
  std::array<char, 64> bytes{};
  const ssize_t got = ::read(STDIN_FILENO, bytes.data(), bytes.size());
  if (got <= 0) return Key::kQuit;  // the terminal is closed
  return last_key({bytes.data(), static_cast<std::size_t>(got)});
}

void show_state(Client& client, const types::Twist2& wanted) {
  const auto status = client.call("status", Json::object(), kPatience);
  if (!status) return;
  fmt::print("\r\033[K{:5.2f} m/s {:5.2f} rad/s wanted; {}", wanted.v_mps, wanted.omega_radps,
             watch_line(*status));
  std::fflush(stdout);
}

double limit_of(const Json& status, const char* path) {
  const Json::json_pointer pointer(path);
  return status.contains(pointer) && status[pointer].is_number() ? status[pointer].get<double>() : 0.0;
}

types::Status serve_keys(Client& client, double v_max_mps, double omega_max_radps) {
  Key key = Key::kStop;
  types::Stamp heard{}, sent{}, shown{};
  while (!interrupted()) {
    const auto pressed = wait_for_key();
    const types::Stamp now = io::monotonic_now();
    if (pressed == Key::kQuit) return {};
    if (pressed) {
      key = *pressed;
      heard = now;
    }
    const bool moving = now - heard < kKeyHolds;
    const types::Twist2 wanted = moving ? twist_of(key, v_max_mps, omega_max_radps) : types::Twist2{};
    if (moving && now - sent >= kPeriod * 9 / 10) {
      if (auto told = tell(client, wanted); !told) return told;
      sent = now;
    }
    if (now - shown < 3 * kPeriod) continue;
    show_state(client, wanted);
    shown = now;
  }
  return {};
}

}  // namespace

int drive_for(const Arguments& arguments) {
  auto client = Client::connect(arguments.socket);
  if (!client) return complain(client.error());
  catch_signals();
  const types::Stamp end = io::monotonic_now() + types::from_seconds(arguments.drive.seconds);
  while (!interrupted() && io::monotonic_now() < end) {
    if (const auto told = tell(*client, {arguments.drive.v_mps, arguments.drive.omega_radps}); !told)
      return complain(told.error());
    pause_until(std::min(io::monotonic_now() + kPeriod, end));
  }
  const auto stopped = tell(*client, {});
  return stopped ? kOk : complain(stopped.error());
}

int drive_by_keys(const Arguments& arguments) {
  auto client = Client::connect(arguments.socket);
  if (!client) return complain(client.error());
  const auto status = client->call("status", Json::object(), kPatience);
  if (!status) return complain(status.error());
  catch_signals();  // before the terminal's mode is changed, so that a signal does not leave it changed
  const RawTerminal terminal;
  if (!terminal.raw()) {
    fmt::print(stderr, "topoctl: driving by keys needs a terminal; in scripts: topoctl drive V W --for S\n");
    return kFailed;
  }
  fmt::print("arrow keys or w a s d drive while held, space stands, q ends; the stop zone holds\n");
  const auto driven = serve_keys(*client, limit_of(*status, "/limits/v_max_mps"),
                                 limit_of(*status, "/limits/omega_max_radps"));
  fmt::print("\n");
  if (!driven) return complain(driven.error());
  const auto stopped = tell(*client, {});
  return stopped ? kOk : complain(stopped.error());
}

}  // namespace topo::daemon
