// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/setup/configuration_text.hpp"

#include <algorithm>
#include <array>

#include "daemon/config/key_table.hpp"
#include "daemon/config/load.hpp"
#include "daemon/setup/templates.hpp"

namespace topo::daemon {
namespace {

constexpr std::string_view kCoronal = "scanner.coronal";

constexpr std::array<std::string_view, 24> kKeys{"robot.name",
                                                 "robot.model",
                                                 "robot.length_front_m",
                                                 "robot.length_rear_m",
                                                 "robot.width_m",
                                                 "base.address",
                                                 "base.name",
                                                 "base.serial_number",
                                                 "base.family",
                                                 "scanner.front.address",
                                                 "scanner.front.serial_number",
                                                 "scanner.front.x_m",
                                                 "scanner.front.y_m",
                                                 "scanner.front.z_m",
                                                 "scanner.front.yaw_rad",
                                                 "scanner.front.roll_rad",
                                                 "scanner.front.mirrored",
                                                 "scanner.coronal.address",
                                                 "scanner.coronal.serial_number",
                                                 "scanner.coronal.x_m",
                                                 "scanner.coronal.y_m",
                                                 "scanner.coronal.z_m",
                                                 "scanner.coronal.roll_rad",
                                                 "scanner.coronal.mirrored"};

bool is_written(std::string_view path) { return std::find(kKeys.begin(), kKeys.end(), path) != kKeys.end(); }

}  // namespace

std::string first_configuration(RobotModel model) {
  const std::string_view example = model == RobotModel::kP3at ? kExampleP3at : kExampleP3dx;
  std::string text =
      "# Topometric, first written by `topoctl setup`. Every key there is stands here: those without # were "
      "found\n"
      "# or are usual, those behind # show their default. `topometricd --check-config FILE` finds every "
      "fault at\n"
      "# once. SI units, angles in radians counter-clockwise; x forward, y left, z up, from the centre of "
      "rotation\n"
      "# on the floor.\n\n";
  return text.append(example.substr(std::min(example.find("[robot]"), example.size())));
}

std::vector<KeyEdit> setup_edits(std::string_view text, const Configuration& wanted) {
  const LoadedConfiguration before = parse_configuration(text, "");
  std::vector<KeyEdit> edits;
  for (const KeySpec& key : key_table()) {
    if (!is_written(key.path) || (key.section() == kCoronal && !wanted.coronal.present)) continue;
    std::string value = value_text(key, wanted);
    const bool there = before.places.contains(key.path);
    if (value != value_text(key, before.values) || (key.required && !there))
      edits.push_back({key.path, std::move(value)});
  }
  return edits;
}

std::string configuration_text(std::string_view text, const Configuration& wanted) {
  const std::string out = edited(text, setup_edits(text, wanted));
  return wanted.coronal.present ? out : without_section(out, kCoronal);
}

}  // namespace topo::daemon
