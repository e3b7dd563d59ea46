// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/plausibility/doubt.hpp"

namespace topo::plausibility {

const std::array<DoubtText, kDoubts>& doubt_texts() {
  static constexpr std::array<DoubtText, kDoubts> kTexts{{
      {"disobeys", "the base moves otherwise than commanded",
       "the base gets an emergency stop and then nothing, so that its own watchdog stops it: press its stop "
       "button, look at cable and controller; ends when its motors are off, its controller was reset, or by "
       "`topoctl clear-estop` while it stands"},
      {"motors_off", "the motors were switched off on the robot",
       "somebody pressed its MOTORS button, or the firmware did it: they stay off; ends by `topoctl "
       "clear-estop` while it stands"},
      {"answers_late", "the wheels follow the commands too late",
       "look for a slow or buffering line to the base (a bridge, a hub, a loaded radio); ends by itself, and "
       "after the third time in a minute by `topoctl clear-estop`"},
      {"impossible_motion", "the base reports a motion that its model cannot make",
       "look at encoders, controller and line; ends after a second of possible reports"},
      {"match_disagrees", "odometry and the front scanner measure different motions",
       "are the scanners exchanged, is one of another robot, is a mount (yaw_rad, mirrored) wrong, do the "
       "wheels slip, was the robot carried? It ends when the robot stands, and after the third time in a "
       "minute "
       "by `topoctl clear-estop`"},
      {"late_scans", "the front scanner's data wait on their line",
       "use a faster line, fewer beams or skip_scans; ends when scans are fresh again"},
      {"late_statuses", "the base's reports wait on their line",
       "use a faster line or rate; ends when reports are fresh again"},
      {"blind", "the front scanner reports nothing in front of the robot",
       "is it covered by something that it cannot see, or defect? In a place without walls within its range "
       "set plausibility.open_space = true; ends when it sees something"},
      {"failed", "the front scanner's beams report faults",
       "a strong light or another scanner shines into it, or it is defect: switch its power off and on; ends "
       "when it measures again"},
      {"frozen", "the front scanner repeats one picture",
       "switch its power off and on; ends with the next different picture"},
      {"covered", "something lies on the front scanner",
       "clean it; ends when it sees past its own hull again"},
  }};
  return kTexts;
}

const DoubtText& text_of(Doubt doubt) { return doubt_texts()[static_cast<std::size_t>(doubt)]; }

std::string_view found_text(const DoubtSet& doubts) {
  for (std::size_t i = 0; i < kDoubts; ++i) {
    if (doubts.test(i)) return doubt_texts()[i].found;
  }
  return {};
}

}  // namespace topo::plausibility
