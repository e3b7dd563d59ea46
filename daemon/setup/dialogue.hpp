// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/calibration/mounting.hpp"
#include "daemon/config/configuration.hpp"
#include "daemon/setup/found.hpp"

namespace topo::daemon {

// The dialogue of `topoctl setup` as values: a state and an answer give the next state, a state has a
// question.

enum class Ask {
  kBase,     ///< which of several
  kFamily,   ///< of a base whose subclass names none
  kName,     ///< of the robot
  kAway,     ///< nobody near it
  kAhead,    ///< somebody ahead of it
  kLeft,     ///< and to its left
  kFront,    ///< place of the level scanner
  kCoronal,  ///< place of the upright one
  kHull,
  kWrite
};

enum class SetupEnd { kAgreed, kRefused };

/// What the scanners have told so far.
struct Seen {
  std::vector<calibration::StillPicture> empty;  ///< with nobody near, by scanner
  std::optional<calibration::AheadSeen> ahead;
};

struct SetupState {
  Found found;
  std::string file;      ///< that is written
  std::string text;      ///< as it stands, or the example
  Configuration values;  ///< that are to be written
  Ask ask = Ask::kBase;
  int answers = 0;
  Seen seen;
  std::string remark;           ///< before the next question, or at the end: what the last answer led to
  std::optional<SetupEnd> end;  ///< no more questions
};

inline constexpr int kSetupAnswersMax = 12;

struct Question {
  std::string text;
  std::string otherwise;  ///< what an empty answer means
  bool looks = false;     ///< the scanners are looked at when it is answered
};

/// The first state. Ended at once where what was found does not make a robot, or the file has faults that
/// setup does not cure. `written`: the file's text; nothing: there is no such file.
[[nodiscard]] SetupState begin_setup(Found found, std::string file,
                                     const std::optional<std::string>& written);

[[nodiscard]] Question question(const SetupState& state);

/// The state after an answer. `pictures`: what the scanners see now, by scanner, when the question looks; an
/// empty one is of a scanner that sends nothing. An answer that is none leads to the same question, with a
/// remark. After 12 answers it ends.
[[nodiscard]] SetupState answered(SetupState state, std::string_view answer,
                                  const std::vector<calibration::StillPicture>& pictures);

}  // namespace topo::daemon
