// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/setup/dialogue.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <variant>

#include "daemon/config/forward_view.hpp"
#include "daemon/config/load.hpp"
#include "daemon/config/trimmed.hpp"
#include "daemon/setup/configuration_text.hpp"
#include "daemon/setup/dialogue_text.hpp"
#include "drivers/pioneer/robot_models.hpp"

namespace topo::daemon {
namespace {

using Pictures = std::vector<calibration::StillPicture>;

/// What an answer leads to: nothing when it was taken, else why it was not.
using Refusal = std::optional<std::string>;

SetupState ended(SetupState state, SetupEnd end, std::string remark) {
  state.end = end;
  state.remark = std::move(remark);
  return state;
}

/// A name that the configuration takes, from what the base calls itself.
std::string robot_name(std::string_view told) {
  constexpr std::size_t kLongest = 32;
  std::string name;
  for (const char c : told.substr(0, kLongest)) {
    const bool good = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-';
    name += good ? c : '_';
  }
  return name.empty() ? RobotConfig{}.name : name;
}

/// The first fault that the file would have with these values; empty: none.
std::string first_fault(const SetupState& state) {
  const LoadedConfiguration checked =
      parse_configuration(configuration_text(state.text, state.values), state.file);
  return checked.faults.empty() ? std::string() : checked.faults.front().message;
}

void take_base(SetupState& state, const FoundBase& base) {
  state.values.base.address = base.address;
  state.values.base.name = base.name;
  state.values.base.serial_number = base.serial_number;
  if (!base.chassis.empty()) {
    state.values.base.family.clear();
    state.values.robot.model = base.chassis == "p3at" ? RobotModel::kP3at : RobotModel::kP3dx;
  }
}

const FoundBase& taken_base(const SetupState& state) {
  const auto& bases = state.found.bases;
  const auto at = std::find_if(bases.begin(), bases.end(),
                               [&](const FoundBase& b) { return b.address == state.values.base.address; });
  return at == bases.end() ? bases.front() : *at;
}

void identify(ScannerConfig& scanner, const FoundScanner& found) {
  scanner.present = true;
  scanner.address = found.address;
  scanner.serial_number = found.serial_number;
}

// One function a question that is no choice between two states: it takes the answer into the state.

Refusal on_base(SetupState& state, std::string_view answer) {
  std::size_t number = 0;
  const auto [stop, error] = std::from_chars(answer.data(), answer.data() + answer.size(), number);
  if (error != std::errc{} || stop != answer.data() + answer.size() || number < 1 ||
      number > state.found.bases.size())
    return fmt::format("found \"{}\", expected the number of a base, 1 to {}.", answer,
                       state.found.bases.size());
  take_base(state, state.found.bases[number - 1]);
  return {};
}

Refusal on_family(SetupState& state, std::string_view answer) {
  const pioneer::RobotModel* family = pioneer::find_model(answer);
  if (family == nullptr)
    return fmt::format("found \"{}\", expected one of {}.", answer, pioneer::known_families());
  state.values.base.family = std::string(family->subclass);
  state.values.robot.model = family->chassis == "p3at" ? RobotModel::kP3at : RobotModel::kP3dx;
  return {};
}

/// An answer to a question that only wants to be told that somebody stands right.
Refusal expect_ready(std::string_view answer) {
  if (answer == "ready") return {};
  return fmt::format("found \"{}\", expected the Enter key alone when it is so, or q to end.", answer);
}

Refusal expect_scans(const SetupState& state, const Pictures& pictures) {
  for (std::size_t i = 0; i < state.found.scanners.size(); ++i)
    if (i >= pictures.size() || pictures[i].range_m.empty())
      return fmt::format("the scanner at {} sends no scans at present; see to its cable and power.",
                         state.found.scanners[i].address);
  return {};
}

Refusal on_ahead(SetupState& state, const Pictures& pictures) {
  const auto told = calibration::level_scanner(state.seen.empty, pictures, yaw_max_rad());
  if (const auto* doubt = std::get_if<calibration::MountDoubt>(&told)) return doubt_text(*doubt);
  const auto& ahead = std::get<calibration::AheadSeen>(told);
  const auto& scanners = state.found.scanners;
  state.seen.ahead = ahead;
  identify(state.values.front, scanners[ahead.scanner]);
  state.values.coronal.present = scanners.size() == 2;
  if (scanners.size() == 2) identify(state.values.coronal, scanners[1 - ahead.scanner]);
  return {};
}

/// Whoever stands ahead does not stand there to a degree: small yaws are left to `topoctl calibrate`.
double coarse_yaw(double yaw_rad, double before_rad) {
  constexpr double kStanding_rad = 20.0 * types::kDegree_rad, kHundredth = 0.01;
  if (std::abs(types::wrap_angle(yaw_rad - before_rad)) < kStanding_rad) return before_rad;
  if (std::abs(yaw_rad) < kStanding_rad) return 0.0;
  return kHundredth * std::round(yaw_rad / kHundredth);
}

Refusal on_left(SetupState& state, const Pictures& pictures) {
  constexpr double kThousandth = 0.001;
  const calibration::AheadSeen& ahead = *state.seen.ahead;
  const auto level =
      calibration::level_mount(ahead.angle_rad, state.seen.empty[ahead.scanner], pictures[ahead.scanner]);
  if (const auto* doubt = std::get_if<calibration::MountDoubt>(&level)) return doubt_text(*doubt);
  const auto& front = std::get<calibration::LevelMount>(level);
  if (state.values.coronal.present) {
    const std::size_t other = 1 - ahead.scanner;
    const auto upright = calibration::upright_mount(state.seen.empty[other], pictures[other]);
    if (const auto* doubt = std::get_if<calibration::MountDoubt>(&upright)) return doubt_text(*doubt);
    const auto& mount = std::get<calibration::UprightMount>(upright);
    state.values.coronal.roll_rad = kThousandth * std::round(mount.roll_rad / kThousandth);
    state.values.coronal.z_m = kThousandth * std::round(mount.z_m / kThousandth);
    state.values.coronal.mirrored = mount.mirrored;
  }
  state.values.front.yaw_rad = coarse_yaw(front.yaw_rad, state.values.front.yaw_rad);
  state.values.front.mirrored = front.mirrored;
  state.values.front.roll_rad = 0.0;
  return {};
}

/// Exactly three numbers, separated by blanks.
std::optional<std::array<double, 3>> three_numbers(std::string_view text) {
  std::array<double, 3> out{};
  for (double& value : out) {
    text = trimmed(text);
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || !std::isfinite(value)) return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(stop - text.data()));
    if (!text.empty() && text.front() != ' ' && text.front() != '\t') return std::nullopt;
  }
  return trimmed(text).empty() ? std::optional(out) : std::nullopt;
}

Refusal on_numbers(std::string_view answer, std::array<double*, 3> into) {
  const auto numbers = three_numbers(answer);
  if (!numbers)
    return fmt::format("found \"{}\", expected three numbers in metres, such as 0.02 0 0.3.", answer);
  for (std::size_t i = 0; i < into.size(); ++i) *into[i] = (*numbers)[i];
  return {};
}

Refusal on_place(std::string_view answer, ScannerConfig& scanner) {
  return on_numbers(answer, {&scanner.x_m, &scanner.y_m, &scanner.z_m});
}

Refusal on_hull(SetupState& state, std::string_view answer) {
  RobotConfig& robot = state.values.robot;
  return on_numbers(answer, {&robot.length_front_m, &robot.length_rear_m, &robot.width_m});
}

Refusal take(SetupState& state, std::string_view answer, const Pictures& pictures) {
  if (question(state).looks) {
    if (auto refused = expect_ready(answer)) return refused;
    if (auto refused = expect_scans(state, pictures)) return refused;
  }
  switch (state.ask) {
    case Ask::kBase:
      return on_base(state, answer);
    case Ask::kFamily:
      return on_family(state, answer);
    case Ask::kName:
      state.values.robot.name = std::string(answer);
      return {};
    case Ask::kAway:
      state.seen.empty = pictures;
      return {};
    case Ask::kAhead:
      return on_ahead(state, pictures);
    case Ask::kLeft:
      return on_left(state, pictures);
    case Ask::kFront:
      return on_place(answer, state.values.front);
    case Ask::kCoronal:
      return on_place(answer, state.values.coronal);
    case Ask::kHull:
      return on_hull(state, answer);
    case Ask::kWrite:
      return answer == "y" || answer == "yes" || answer == "n" || answer == "no"
                 ? Refusal()
                 : fmt::format("found \"{}\", expected y or n.", answer);
  }
  return {};
}

bool is_asked(const SetupState& state, Ask ask) {
  if (ask == Ask::kBase) return state.found.bases.size() > 1;
  if (ask == Ask::kFamily) return taken_base(state).chassis.empty();
  return ask != Ask::kCoronal || state.values.coronal.present;
}

Ask next_of(const SetupState& state) {
  auto ask = state.ask;
  do ask = static_cast<Ask>(static_cast<int>(ask) + 1);
  while (!is_asked(state, ask));
  return ask;
}

/// Answers whose values must stand the same check as the file.
bool is_checked(Ask ask) { return ask == Ask::kName || (ask >= Ask::kLeft && ask <= Ask::kHull); }

std::string what_is_missing(const Found& found) {
  if (found.bases.empty())
    return "no base was found: is it switched on, and its cable plugged in? Where it is on a network, --base "
           "tcp:HOST:PORT says where.";
  if (found.scanners.empty())
    return "no scanner was found: is it powered, and this computer in its network? --tcp HOST and --serial "
           "PATTERN say where else to look.";
  if (found.scanners.size() > 2)
    return fmt::format(
        "found {} scanners, expected one or two: switch off those that this robot does not use.",
        found.scanners.size());
  return {};
}

/// What is found, as far as it is told apart already: only faults stay that setup does not cure.
void take_found(SetupState& state) {
  take_base(state, state.found.bases.front());
  ScannerConfig& front = state.values.front;
  identify(front, state.found.scanners.front());
  front.roll_rad = 0.0;
  if (!forward_view_fault(front.yaw_rad).empty()) front.yaw_rad = 0.0;
  state.values.coronal.present = false;
}

}  // namespace

SetupState begin_setup(Found found, std::string file, const std::optional<std::string>& written) {
  SetupState state;
  state.found = std::move(found);
  state.file = std::move(file);
  if (const std::string missing = what_is_missing(state.found); !missing.empty())
    return ended(std::move(state), SetupEnd::kRefused, missing);
  const bool at = state.found.bases.front().chassis == "p3at";
  state.text = written.value_or(first_configuration(at ? RobotModel::kP3at : RobotModel::kP3dx));
  state.values = parse_configuration(state.text, state.file).values;
  const bool named = state.values.robot.name != RobotConfig{}.name;
  take_found(state);
  const std::string faults =
      faults_text(parse_configuration(configuration_text(state.text, state.values), state.file));
  if (!faults.empty()) {
    std::string why = fmt::format("{} has faults that this does not cure; mend it or put it aside:\n{}",
                                  state.file, faults);
    return ended(std::move(state), SetupEnd::kRefused, std::move(why));
  }
  if (!written || !named) state.values.robot.name = robot_name(state.values.base.name);
  if (!is_asked(state, Ask::kBase)) state.ask = next_of(state);
  return state;
}

SetupState answered(SetupState state, std::string_view answer, const Pictures& pictures) {
  if (state.end) return state;
  ++state.answers;
  state.remark.clear();
  std::string_view said = trimmed(answer);
  const std::string otherwise = question(state).otherwise;
  if (said.empty()) said = otherwise;
  if (said == "q" || said == "quit")
    return ended(std::move(state), SetupEnd::kRefused, "ended before its end.");

  SetupState next = state;
  Refusal refused = take(next, said, pictures);
  if (!refused && is_checked(state.ask))
    if (std::string fault = first_fault(next); !fault.empty()) refused = std::move(fault);
  if (!refused && state.ask == Ask::kWrite)
    return said.front() == 'y' ? ended(std::move(next), SetupEnd::kAgreed, {})
                               : ended(std::move(next), SetupEnd::kRefused, "as you wish.");
  if (refused) {
    state.remark = *refused;
    next = std::move(state);
  } else {
    if (next.ask == Ask::kLeft) next.remark = mounts_text(next.values);
    next.ask = next_of(next);
    if (next.ask == Ask::kWrite) next.remark = changes_text(next);
  }
  if (next.answers < kSetupAnswersMax) return next;
  std::string why = fmt::format("{}\n{} answers are enough: begin again.", next.remark, kSetupAnswersMax);
  return ended(std::move(next), SetupEnd::kRefused, std::move(why));
}

}  // namespace topo::daemon
