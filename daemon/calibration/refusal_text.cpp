// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/calibration/refusal_text.hpp"

#include <fmt/format.h>

#include <array>

namespace topo::daemon {
namespace {

using calibration::Doubt;
using calibration::Refusal;

std::string turn_text(const Refusal& r, const char* side) {
  return fmt::format(
      "it turned to the {} by {:.0f} degrees in all, {:.0f} are needed: without turns to both sides the "
      "track, the "
      "scanner's place and the delay do not show; drive eights",
      side, in_degrees(r.found), in_degrees(r.needed));
}

/// What the drive did not have enough of, by the number that stays uncertain.
std::string_view missing(calibration::Number number) {
  switch (number) {
    case calibration::kWheelLeft:
    case calibration::kWheelRight:
      return "drive further";
    case calibration::kTrack:
    case calibration::kPlaceX:
    case calibration::kPlaceY:
      return "turn more, to both sides";
    case calibration::kYaw:
      return "drive further straight ahead";
    default:
      return "begin and end turns more often: the delay shows only where the turning speed changes";
  }
}

}  // namespace

std::string_view number_name(calibration::Number number) {
  static constexpr std::array<std::string_view, calibration::kNumbers> kNames{
      "left wheel",
      "right wheel",
      "track",
      "yaw of the front scanner",
      "place of the front scanner, ahead",
      "place of the front scanner, left",
      "delay of status packets"};
  return kNames.at(static_cast<std::size_t>(number));
}

std::string refusal_text(const Refusal& r) {
  const auto number = r.number.value_or(calibration::kWheelLeft);
  switch (r.doubt) {
    case Doubt::kNoOdometry:
      return "there are no status packets of the base in it";
    case Doubt::kNoScans:
      return "there is no scan of the front scanner with status packets around it";
    case Doubt::kShort:
      return fmt::format("the drive takes {:.0f} s, {:.0f} s are needed, better three minutes", r.found,
                         r.needed);
    case Doubt::kNoWay:
      return fmt::format(
          "it drove {:.1f} m, {:.0f} m are needed: without a way the wheels and the scanner's yaw do not "
          "show",
          r.found, r.needed);
    case Doubt::kNoTurnLeft:
      return turn_text(r, "left");
    case Doubt::kNoTurnRight:
      return turn_text(r, "right");
    case Doubt::kUnmatched:
      return fmt::format(
          "only {:.0f} % of the scans fit those before them: drive where the scanner sees walls, not glass "
          "or open "
          "space, and without people around",
          100.0 * r.found);
    case Doubt::kDegenerate:
      return fmt::format(
          "{:.0f} % of the scans leave a direction open, as in a corridor or a hall of glass: drive in a "
          "room with "
          "walls on three sides",
          100.0 * r.found);
    case Doubt::kPoorFit:
      return fmt::format(
          "scans fit those before them badly (half of them to {:.0f} % or less): glass, people, or a scanner "
          "that is "
          "not level",
          100.0 * r.found);
    case Doubt::kAgainstWheels:
      return "scanner and wheels turn in opposite senses: mirrored of [scanner.front] is wrong, or the plugs "
             "of the "
             "motors are exchanged (topoctl wheels-up)";
    case Doubt::kOpen:
      return "the drive leaves a number open: drive eights, and some metres straight";
    case Doubt::kSlipped:
      return fmt::format(
          "{:.0f} % of the drive contradicts the rest: wheels slipped, or the robot was pushed or carried",
          100.0 * r.found);
    case Doubt::kMoved:
      return fmt::format(
          "the front scanner was elsewhere on the robot in the half minute from {:.0f} s on: it was bumped, "
          "or sits "
          "loose; fasten it and drive again",
          r.found);
    case Doubt::kUncertain:
      return fmt::format("{}: known to {:.2g}, {:.2g} is needed: {}", number_name(number), r.found, r.needed,
                         missing(number));
    case Doubt::kImpossible:
      return fmt::format("{}: {:.3g} is beyond {:.3g}, which no such robot has: is the model right?",
                         number_name(number), r.found, r.needed);
  }
  return {};
}

}  // namespace topo::daemon
