// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bitset>
#include <cstdint>
#include <string_view>

namespace topo::plausibility {

/// A contradiction between what was commanded, measured, matched and seen. The robot stops for each of them.
/// Graver ones first: the first of a set is shown.
enum class Doubt : std::uint8_t {
  kDisobeys,          ///< the base moves faster than commanded, or against the command
  kMotorsOff,         ///< the motors were switched off, and not by the host
  kAnswersLate,       ///< the wheels follow the commands too late
  kImpossibleMotion,  ///< a speed that the model does not reach, or a jump of the pose
  kMatchDisagrees,    ///< odometry and scan matching measure different motions
  kLateScans,         ///< the scans wait on their line
  kLateStatuses,      ///< the status packets wait on their line
  kBlind,             ///< the front scanner reports nothing in front of the robot
  kFailed,            ///< the front scanner's beams report faults in place of ranges
  kFrozen,            ///< the front scanner repeats one picture
  kCovered,           ///< something lies on the front scanner
};
inline constexpr std::size_t kDoubts = 11;

using DoubtSet = std::bitset<kDoubts>;
[[nodiscard]] inline bool has(const DoubtSet& doubts, Doubt doubt) {
  return doubts.test(static_cast<std::size_t>(doubt));
}

/// A doubt for the operator.
struct DoubtText {
  std::string_view name;   ///< for programs: "disobeys"
  std::string_view found;  ///< what is contradictory, as a clause
  std::string_view cure;   ///< what to look at, and how the doubt ends
};
[[nodiscard]] const DoubtText& text_of(Doubt doubt);

/// Doubts in the order of Doubt.
[[nodiscard]] const std::array<DoubtText, kDoubts>& doubt_texts();

/// The text of the gravest doubt; of an empty set an empty clause.
[[nodiscard]] std::string_view found_text(const DoubtSet& doubts);

}  // namespace topo::plausibility
