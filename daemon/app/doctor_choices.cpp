// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// Warnings about what the configuration permits although something else would be safer.
#include <fmt/format.h>

#include <cmath>

#include "core/types/braking.hpp"
#include "core/types/robot_limits.hpp"
#include "daemon/app/doctor.hpp"
#include "daemon/config/masks.hpp"

namespace topo::daemon {
namespace {

// The values from which on a choice is daring.
constexpr double kMargin_m = 0.03;  // accuracy of a UTM-30LX below 10 m (PROTOCOLS section 11)
constexpr double kSpeed_mps = 0.7;  // default, at which the stop tests are run

Check check_sonar(const Configuration& c) {
  if (c.base.sonar) return {"sonar", true, "on", {}, {}};
  return {"sonar",
          true,
          "off (base.sonar = false)",
          {},
          "glass, what is below or above the front scanner's plane, and what a scanner with wrong data hides "
          "are then seen by "
          "nothing; base.sonar = true"};
}

Check check_margin(const Configuration& c) {
  const double margin_m = c.motion.margin_m;
  Check check{"margin", true, fmt::format("{} m", margin_m), {}, {}};
  if (margin_m < kMargin_m) {
    check.safer = fmt::format(
        "the scanner measures to {} m, so that the hull may touch what the robot stops before; "
        "motion.margin_m = "
        "{} or more",
        kMargin_m, types::RobotLimits{}.margin_m);
  }
  return check;
}

Check check_stamps(const Configuration& c) {
  std::string offsets, safer;
  for (const auto& [name, scanner] : {std::pair("front", &c.front), std::pair("coronal", &c.coronal)}) {
    const double offset_s = scanner->stamp_offset_s;
    if (!scanner->present || offset_s == 0.0) continue;
    offsets += fmt::format("{}{}: {} s", offsets.empty() ? "" : ", ", name, offset_s);
    safer += fmt::format("{} data count as {:.0f} ms {} than the sensor says, at full speed {:.3f} m; ", name,
                         std::abs(offset_s) * 1e3, offset_s > 0.0 ? "younger" : "older",
                         std::abs(offset_s) * c.base.v_max_mps);
  }
  if (offsets.empty()) return {"stamps", true, "as the scanners give them", {}, {}};
  return {"stamps",
          true,
          "shifted, " + offsets,
          {},
          safer + "stamp_offset_s = 0 unless it was measured for this model"};
}

Check check_serial_numbers(const Configuration& c) {
  std::string known, missing;
  const auto note = [&](std::string_view section, bool there, const std::string& serial_number) {
    if (!there) return;
    std::string& list = serial_number.empty() ? missing : known;
    list += list.empty() ? "" : ", ";
    list += serial_number.empty() ? fmt::format("{}.serial_number", section)
                                  : fmt::format("{} {}", section, serial_number);
  };
  note("base", true, c.base.serial_number);
  note("scanner.front", c.front.present, c.front.serial_number);
  note("scanner.coronal", c.coronal.present, c.coronal.serial_number);
  if (missing.empty()) return {"serial numbers", true, "all are expected: " + known, {}, {}};
  return {
      "serial numbers",
      true,
      fmt::format("any is accepted: {} not set", missing),
      {},
      "exchanged scanners or another robot's base would be driven with; set them as topoctl status --json "
      "tells them (devices, identity)"};
}

Check check_speed(const Configuration& c) {
  const types::DriveLimits& base = c.base;
  Check check{"speed", true, fmt::format("at most {} m/s", base.v_max_mps), {}, {}};
  if (base.v_max_mps > kSpeed_mps) {
    const auto braking_m = [&](double v_mps) { return types::braking_m(v_mps, base.deceleration_mps2); };
    check.safer = fmt::format(
        "braking alone takes {:.2f} m ({:.2f} m at {} m/s), without what comes late; base.v_max_mps = {} or "
        "less",
        braking_m(base.v_max_mps), braking_m(kSpeed_mps), kSpeed_mps, kSpeed_mps);
  }
  return check;
}

Check check_masks(const Configuration& c) {
  std::string found;
  for (const auto& [name, scanner] : {std::pair("front", &c.front), std::pair("coronal", &c.coronal)}) {
    if (!scanner->present || scanner->masks.count == 0) continue;
    found += fmt::format("{}{}: {} degrees", found.empty() ? "" : ", ", name, sectors_text(scanner->masks));
  }
  if (found.empty()) return {"masks", true, "none", {}, {}};
  return {
      "masks",
      true,
      "not looked at, " + found,
      {},
      "what stands in these sectors is seen when the robot has turned, or by sonar alone; no wider than the "
      "robot's own posts"};
}

Check check_team_security(const TeamConfig& team) {
  if (team.secure()) return {"team security", true, "credentials in " + team.security, {}, {}};
  return {
      "team security",
      true,
      "off (team.security = \"off\")",
      {},
      fmt::format(
          "who is in reach of {} can read, disturb and command the team; topometric-team new and add make "
          "credentials",
          team.interface)};
}

}  // namespace

std::vector<Check> examine_choices(const Configuration& configuration) {
  std::vector<Check> checks{check_sonar(configuration),  check_margin(configuration),
                            check_stamps(configuration), check_serial_numbers(configuration),
                            check_speed(configuration),  check_masks(configuration)};
  if (configuration.team.present) checks.push_back(check_team_security(configuration.team));
  return checks;
}

}  // namespace topo::daemon
