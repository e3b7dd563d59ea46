// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/fuzz/drive/oracle.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace topo::fuzz {
namespace {

using std::chrono::milliseconds;
using types::Duration;
using types::Stamp;

constexpr Duration kLate = milliseconds(300);  // PlausibilityParams::late_max
// By arrival 2.5 periods, and late; then the sweep's time on its way and the period of control.
constexpr Duration kScanKnown = milliseconds(250) + kLate + milliseconds(150);
// Ten equal pictures, or a second without sight at 10 Hz, and those of a period.
constexpr int kLieScans = 12;
// The robot stands a second after the last lie: the time to brake.
constexpr Duration kLieOver = milliseconds(1500);
// By arrival 300 ms, and late; sampled 60 ms before it is sent; the drift that is allowed of 1 % over the
// run.
constexpr Duration kStatusKnown = milliseconds(300) + kLate + milliseconds(60 + 50 + 250);
// Disobedience is known after three statuses outside of bounds that narrow with half the braking; then the
// watchdog and the braking.
constexpr Duration kDeafStands = milliseconds(8000);
constexpr Duration kLastWords = milliseconds(500);

std::string text(const char* what, double value) {
  std::array<char, 160> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%s (%.3f)", what, value);
  return buffer.data();
}

/// What the newest decision lets the wheels do.
types::Twist2 granted(const Host& host) {
  const types::BaseCommand& command = host.output().command;
  const bool moves = host.sent() && command.enable_motors && !command.estop && !command.silence;
  return moves ? command.twist : types::Twist2{};
}

bool moves(const types::Twist2& twist) {
  return std::abs(twist.v_mps) > 1e-3 || std::abs(twist.omega_radps) > 1e-2;
}

/// The newest pictures are lies: each is noticed in time, but not at once, and not how near to something a
/// robot that waits is.
bool is_lied_to(const World& world) {
  const Stamp lie = world.scan_line.heard().lie;
  return lie != Stamp{} && world.now() - lie < kLieOver;
}

/// A base that swallows its commands drives until its watchdog is no longer fed.
bool is_run_away(const World& world) {
  return world.swallowed() != Stamp{} && world.now() - world.swallowed() < kDeafStands;
}

/// What the base says arrives, and what it is sent.
bool is_clear(const World& world, const Host& host) {
  const LineFaults& line = world.base_line.faults;
  return !line.holds && !line.swallows && line.drop_permille == 0 && line.flip_permille == 0 &&
         host.now() - world.base_line.heard().news < kLate && !world.command_faults.lost;
}

}  // namespace

std::string Oracle::judge(const World& world, const Host& host) {
  std::string lag = judge_lag(world, host);
  if (is_lied_to(world) || is_run_away(world) || is_late(host)) excused_ = world.collisions();
  if (world.collisions() > excused_) return text("the robot drove into something", world.pose().x_m);
  if (moves(granted(host)) && host.estop_pressed()) return "motion is commanded while the e-stop is pressed";
  if (std::string found = judge_silence(world, host); !found.empty()) return found;
  if (std::string found = judge_deaf(world, host); !found.empty()) return found;
  if (!moves(granted(host))) return {};
  if (!lag.empty()) return lag;
  if (std::string found = judge_age(world, host); !found.empty()) return found;
  return judge_way(world, host);
}

/// Motion while what the host has of the world is older than what must be noticed.
std::string Oracle::judge_age(const World& world, const Host& host) {
  const Stamp now = host.now();
  const Heard& scans = world.scan_line.heard();
  const Duration scan = now - scans.news, status = now - world.base_line.heard().news;
  const bool deceived = scans.lies > 0 && scans.lies <= kLieScans && now - scans.lie <= kScanKnown;
  if (scan > kScanKnown + world.scan_line.began_late() && !deceived)
    return text("motion is commanded while the newest true scan is too old", types::to_seconds(scan));
  if (status > kStatusKnown + world.base_line.began_late())
    return text("motion is commanded while the newest true status is too old", types::to_seconds(status));
  return {};
}

/// Motion into what stands there and was seen: along the commanded arc for a tenth of a second, then braking.
std::string Oracle::judge_way(const World& world, const Host& host) {
  constexpr double kStep_s = 0.02, kReaction_s = 0.1, kBraking_mps2 = 0.5;
  constexpr Duration kSeen = milliseconds(900);  // kScanKnown and a sweep
  const Stamp now = host.now();
  types::Twist2 twist = granted(host);
  if (!(twist.v_mps > 0.0) || is_lied_to(world)) return {};
  types::Se2 pose = world.pose();
  for (double t = 0.0; twist.v_mps > 0.0; t += kStep_s) {
    pose = pose * types::Se2{twist.v_mps * kStep_s, 0.0, twist.omega_radps * kStep_s};
    if (world.touches(pose, now - kSeen)) return text("motion is commanded into something", t);
    if (t < kReaction_s) continue;
    const double slower = std::max(twist.v_mps - kBraking_mps2 * kStep_s, 0.0);
    twist.omega_radps *= twist.v_mps > 0.0 ? slower / twist.v_mps : 0.0;
    twist.v_mps = slower;
  }
  return {};
}

/// Nothing is sent to a base that does not obey, after its last words.
std::string Oracle::judge_silence(const World& world, const Host& host) {
  if (!host.output().command.silence) {
    silent_since_ = {};
    return {};
  }
  if (silent_since_ == Stamp{}) silent_since_ = host.now();
  if (host.now() - silent_since_ <= kLastWords) {
    bytes_when_silent_ = world.base_bytes();
    return {};
  }
  if (world.base_bytes() == bytes_when_silent_) return {};
  return text("bytes are sent to a base that does not obey",
              static_cast<double>(world.base_bytes() - bytes_when_silent_));
}

/// Motion while commands take long: known by the answer to a request, which is made twice a second. Until
/// then the robot runs on with what was commanded (doc/faults.md).
std::string Oracle::judge_lag(const World& world, const Host& host) {
  constexpr Duration kLag = milliseconds(600), kAsked = milliseconds(500), kAnswered = milliseconds(400);
  const Duration delay = world.command_faults.delay;
  if (delay > kLag) late_ = host.now();
  if (delay <= kLag || !is_clear(world, host) || world.lies.deaf) {
    late_since_ = {};
    return {};
  }
  if (late_since_ == Stamp{}) late_since_ = host.now();
  const Duration known = 2 * delay + kAsked + kAnswered;  // a request may be on its way when it begins
  if (host.now() - late_since_ <= known) return {};
  return text("motion is commanded while the base answers late", types::to_seconds(delay));
}

bool Oracle::is_late(const Host& host) const {
  constexpr Duration kStands = milliseconds(6000);
  return late_ != Stamp{} && host.now() - late_ < kStands;
}

/// A base that swallows its commands, and tells truly what it does, stands in the end.
std::string Oracle::judge_deaf(const World& world, const Host& host) {
  if (!world.lies.deaf || !is_clear(world, host)) {
    deaf_since_ = {};
    return {};
  }
  if (deaf_since_ == Stamp{}) deaf_since_ = host.now();
  // Bounds that the command still widens are no contradiction.
  if (moves(granted(host)) || host.wish.v_mps > 0.0) deaf_since_ = host.now();
  if (host.now() - deaf_since_ > kDeafStands && std::abs(world.v_mps()) > 0.05)
    return text("a base that does not obey is kept alive", world.v_mps());
  return {};
}

}  // namespace topo::fuzz
