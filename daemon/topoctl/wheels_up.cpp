// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <optional>
#include <string>

#include "daemon/topoctl/commands.hpp"
#include "drivers/io/posix.hpp"

namespace topo::daemon {
namespace {

constexpr types::Duration kWheelsPeriod =
    std::chrono::milliseconds(100);  ///< the daemon's dead-man time is 300 ms
constexpr types::Duration kMoving = std::chrono::seconds(3);
constexpr types::Duration kStopping = std::chrono::seconds(2);
/// Slow enough that wheels in the air contradict the scans by less than the plausibility check doubts.
constexpr double kAhead_mps = 0.08, kLeft_radps = 0.15;
constexpr double kShare = 0.5;  ///< of the speed, that the wheels must reach
constexpr double kStands_mps = 0.01, kStands_radps = 0.03;

/// What the base told while it was driven, and after the stop.
struct Measured {
  double v_mps = 0.0, omega_radps = 0.0, turned_rad = 0.0;
  bool motors = false;
  double after_v_mps = 0.0, after_omega_radps = 0.0;
  [[nodiscard]] bool stopped() const {
    return std::abs(after_v_mps) < kStands_mps && std::abs(after_omega_radps) < kStands_radps;
  }
};

double told_number(const Json& status, const char* path) {
  const Json::json_pointer at(path);
  return status.contains(at) && status[at].is_number() ? status[at].get<double>() : 0.0;
}

types::Result<Json> drive_and_look(Client& client, double v_mps, double omega_radps, types::Duration time) {
  const types::Stamp end = io::monotonic_now() + time;
  while (!interrupted() && io::monotonic_now() < end) {
    auto told = client.call("drive", Json{{"v_mps", v_mps}, {"omega_radps", omega_radps}}, kPatience);
    if (!told) return told;
    pause_until(std::min(io::monotonic_now() + kWheelsPeriod, end));
  }
  return client.call("status", Json::object(), kPatience);
}

types::Result<Measured> measure(Client& client, double v_mps, double omega_radps) {
  const auto before = client.call("status", Json::object(), kPatience);
  if (!before) return tl::unexpected(before.error());
  const auto moving = drive_and_look(client, v_mps, omega_radps, kMoving);
  const auto after = drive_and_look(client, 0.0, 0.0, kStopping);  // also when the status failed
  if (!moving) return tl::unexpected(moving.error());
  if (!after) return tl::unexpected(after.error());
  const char* const heading = "/odometry/theta_rad";
  Measured out;
  out.v_mps = told_number(*moving, "/twist/v_mps");
  out.omega_radps = told_number(*moving, "/twist/omega_radps");
  out.turned_rad = types::wrap_angle(told_number(*after, heading) - told_number(*before, heading));
  out.motors = moving->value("motors_enabled", false);
  out.after_v_mps = told_number(*after, "/twist/v_mps");
  out.after_omega_radps = told_number(*after, "/twist/omega_radps");
  return out;
}

/// True for an answer that begins with y; false at the end of the input.
bool yes(const char* question) {
  fmt::print("{} [y/n] ", question);
  std::fflush(stdout);
  std::string answer;
  return std::getline(std::cin, answer) && (answer.starts_with('y') || answer.starts_with('Y'));
}

int failed(const std::string& what, const char* cure) {
  fmt::print("failed: {}: {}\n", what, cure);
  return kFailed;
}

int judge_stop(const Measured& m) {
  if (m.stopped()) return kOk;
  return failed(fmt::format("2 s after the stop the wheels turn on, {:.2f} m/s and {:.2f} rad/s",
                            m.after_v_mps, m.after_omega_radps),
                "press the STOP button; do not drive this base before its controller is looked at");
}

int test_ahead(Client& client) {
  const auto m = measure(client, kAhead_mps, 0.0);
  if (!m) return complain(m.error());
  fmt::print("ahead: {:.2f} m/s wanted, {:.2f} m/s and {:.2f} rad/s measured, motors {}\n", kAhead_mps,
             m->v_mps, m->omega_radps, m->motors ? "on" : "off");
  if (!m->motors)
    return failed("the motors did not go on", "release the STOP button; topoctl doctor says more");
  if (std::abs(m->omega_radps) > kLeft_radps && std::abs(m->v_mps) < kShare * kAhead_mps)
    return failed("the wheels turn against each other", "one motor or one encoder has its plug turned round");
  if (m->v_mps < -kStands_mps)
    return failed("the encoders count backwards",
                  "exchange the plugs of the encoders, or of motors and encoders");
  if (m->v_mps < kShare * kAhead_mps)
    return failed("the wheels do not turn", "topoctl doctor says what holds them");
  if (const int status = judge_stop(*m); status != kOk) return status;
  return yes("Did both wheels turn forward, and stop?")
             ? kOk
             : failed("the wheels do not turn as they are told",
                      "exchange the plugs of the motor that turned wrongly");
}

int test_left(Client& client) {
  const auto m = measure(client, 0.0, kLeft_radps);
  if (!m) return complain(m.error());
  fmt::print("left: {:.2f} rad/s wanted, {:.2f} rad/s and {:.2f} m/s measured, heading {:+.1f} degrees\n",
             kLeft_radps, m->omega_radps, m->v_mps, m->turned_rad / types::kDegree_rad);
  if (m->omega_radps < kShare * kLeft_radps || m->turned_rad <= 0.0)
    return failed("the heading does not turn to the left", "left and right motor are exchanged");
  if (const int status = judge_stop(*m); status != kOk) return status;
  return yes("Did the right wheel turn forward and the left one backward?")
             ? kOk
             : failed("left and right are exchanged",
                      "exchange the plugs of left and right motor, with their encoders");
}

}  // namespace

int wheels_up(const Arguments& a) {
  auto client = Client::connect(a.socket);
  if (!client) return complain(client.error());
  catch_signals();
  if (!yes("The wheels will turn. Is the robot lifted, so that they touch nothing, and a hand at STOP?")) {
    fmt::print("nothing was driven\n");
    return kFailed;
  }
  for (int (*test)(Client&) : {&test_ahead, &test_left})
    if (const int status = test(*client); status != kOk) return status;
  fmt::print("passed: both wheels, heading, motors and stop\n");
  return kOk;
}

}  // namespace topo::daemon
