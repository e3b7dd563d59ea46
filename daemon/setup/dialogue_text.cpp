// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/setup/dialogue_text.hpp"

#include <fmt/format.h>

#include <iterator>

#include "daemon/config/configuration.hpp"
#include "daemon/setup/configuration_text.hpp"

namespace topo::daemon {
namespace {

std::string or_unknown(const std::string& text) { return text.empty() ? "not told" : text; }

double in_degrees(double rad) { return rad / types::kDegree_rad; }

}  // namespace

std::string found_text(const Found& found) {
  std::string out;
  for (const FoundBase& base : found.bases)
    fmt::format_to(std::back_inserter(out), "base     {}: {} \"{}\", serial number {}\n", base.address,
                   base.subclass, base.name, or_unknown(base.serial_number));
  for (const FoundScanner& scanner : found.scanners)
    fmt::format_to(std::back_inserter(out), "scanner  {}: {}, serial number {}\n", scanner.address,
                   scanner.product, or_unknown(scanner.serial_number));
  for (const std::string& note : found.notes) fmt::format_to(std::back_inserter(out), "note     {}\n", note);
  return out;
}

std::string doubt_text(calibration::MountDoubt doubt) {
  using D = calibration::MountDoubt;
  switch (doubt) {
    case D::kNobody:
      return "Nobody is seen there who was not there before: stand 1 m from the robot, not behind its posts.";
    case D::kSeveral:
      return "Several things near the robot have changed: only one person may stand within 2 m.";
    case D::kBothAhead:
      return "More than one scanner sees somebody ahead: is none of them upright, across the way, or does "
             "somebody stand beside the robot?";
    case D::kLooksAside:
      return "The level scanner sees you more than 75 degrees from its middle: are you ahead of the robot? "
             "If "
             "so, turn the scanner: braking needs its view to 60 degrees on either side of straight ahead.";
    case D::kNotBeside:
      return "You are seen neither to the left nor to the right of where you were: stand beside the robot, "
             "to its left, level with its scanners.";
    case D::kNotInPlane:
      return "The upright scanner does not see you: stand to the left of the robot, level with that scanner.";
    case D::kNoFloor:
      return "The upright scanner sees no floor to both sides of the robot: the floor must be free for 1 m "
             "to "
             "its left and right. Move it, and begin again.";
  }
  return {};
}

std::string mounts_text(const Configuration& values) {
  const ScannerConfig& front = values.front;
  std::string out = fmt::format(
      "{} ({}) is the level one, {}, its zero beam {:.0f} degrees from straight ahead.", front.address,
      or_unknown(front.serial_number), front.mirrored ? "upside down" : "upright", in_degrees(front.yaw_rad));
  const ScannerConfig& coronal = values.coronal;
  if (coronal.present)
    out += fmt::format(
        "\n{} ({}) looks across the way, its beams from the robot's {}, its zero beam {:.1f} degrees from "
        "straight up, {:.2f} m above the floor.",
        coronal.address, or_unknown(coronal.serial_number),
        coronal.mirrored ? "left to its right" : "right to its left", in_degrees(coronal.roll_rad),
        coronal.z_m);
  return out;
}

std::string changes_text(const SetupState& state) {
  std::string out;
  for (const KeyEdit& edit : setup_edits("", state.values))
    fmt::format_to(std::back_inserter(out), "  {} = {}\n", edit.path, edit.value);
  if (configuration_text(state.text, state.values) == state.text) out += "  It is so already.\n";
  return out;
}

}  // namespace topo::daemon
