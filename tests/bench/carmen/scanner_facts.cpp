// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/carmen/scanner_facts.hpp"

#include <fmt/format.h>

#include <array>
#include <numbers>
#include <string_view>

namespace topo::bench {
namespace {

struct KnownScanner {
  std::size_t beams;
  double first_deg;
  double step_deg;
};

constexpr double kUrgStep_deg = 360.0 / 1024.0;

/// From the makers' data sheets. An even number of a SICK leaves out the last beam.
constexpr std::array<KnownScanner, 23> kKnown{{
    {100, -50.0, 1.0},  // LMS 2xx over 100 degrees
    {101, -50.0, 1.0},
    {180, -90.0, 1.0},  // LMS 2xx over 180 degrees
    {181, -90.0, 1.0},
    {200, -50.0, 0.5},
    {201, -50.0, 0.5},
    {360, -90.0, 0.5},
    {361, -90.0, 0.5},
    {380, -95.0, 0.5},  // LMS 5xx
    {381, -95.0, 0.5},
    {400, -50.0, 0.25},
    {401, -50.0, 0.25},
    {540, -135.0, 0.5},  // LMS 1xx, S 300
    {541, -135.0, 0.5},
    {682, -340.0 * kUrgStep_deg, kUrgStep_deg},  // URG-04LX: steps 44 to 725, 384 ahead
    {683, -341.0 * kUrgStep_deg, kUrgStep_deg},
    {726, -384.0 * kUrgStep_deg, kUrgStep_deg},  // from step 0
    {760, -95.0, 0.25},
    {761, -95.0, 0.25},
    {768, -384.0 * kUrgStep_deg, kUrgStep_deg},
    {769, -384.0 * kUrgStep_deg, kUrgStep_deg},
    {1080, -135.0, 0.25},  // UTM-30LX, LMS 1xx at 25 Hz
    {1081, -135.0, 0.25},
}};

BeamAngles in_radians(double first_deg, double step_deg) {
  return {first_deg * types::kDegree_rad, step_deg * types::kDegree_rad};
}

std::optional<double> within(std::string_view word, double min, double max) {
  const auto value = parse_number(word);
  if (!value || !(*value >= min && *value <= max)) return std::nullopt;
  return value;
}

}  // namespace

types::Se2 ScannerFacts::T_robot_laser() const {
  return {ahead_m.value_or(0.0), left_m.value_or(0.0), types::wrap_angle(turn_rad.value_or(0.0))};
}

void LogFacts::take(const Fields& f) {
  if (f.count() < 3) return;
  constexpr double kFar_m = 1000.0, kRobot_m = 10.0, kRound_deg = 360.0;
  const auto is = [&](std::string_view before, std::string_view which, std::string_view after) {
    return f.word(1) == fmt::format("{}{}{}", before, which, after);
  };
  for (const auto& [which, scanner] :
       {std::pair<std::string_view, ScannerFacts*>("front", &front), {"rear", &rear}}) {
    std::optional<double>* fact = nullptr;
    double min = 0.0, max = 0.0;
    const auto bound = [&](std::optional<double>& value, double low, double high) {
      fact = &value;
      min = low;
      max = high;
    };
    if (is("laser_", which, "_laser_resolution")) bound(scanner->step_deg, 0.01, 5.0);
    if (is("laser_", which, "_laser_fov")) bound(scanner->view_deg, 1.0, kRound_deg);
    if (is("robot_", which, "_laser_max")) bound(scanner->reach_m, 0.5, kFar_m);
    if (is("robot_", which, "laser_offset")) bound(scanner->ahead_m, -kRobot_m, kRobot_m);
    if (is("robot_", which, "laser_side_offset")) bound(scanner->left_m, -kRobot_m, kRobot_m);
    if (is("robot_", which, "laser_angular_offset"))
      bound(scanner->turn_rad, -2.0 * std::numbers::pi, 2.0 * std::numbers::pi);
    if (fact == nullptr) continue;
    if (const auto value = within(f.word(2), min, max)) *fact = value;
  }
}

std::optional<BeamAngles> usual_angles(std::size_t beams) {
  for (const KnownScanner& known : kKnown) {
    if (known.beams == beams) return in_radians(known.first_deg, known.step_deg);
  }
  return std::nullopt;
}

std::optional<BeamAngles> angles_of(std::size_t beams, const ScannerFacts& facts, const LogOptions& options) {
  if (options.beams) return options.beams;
  if (!facts.step_deg && !facts.view_deg) return usual_angles(beams);
  // An even number of beams lacks the last one of a symmetric fan.
  const auto steps = static_cast<double>(beams % 2 == 0 ? beams : beams - 1);
  const double step_deg = facts.step_deg ? *facts.step_deg : *facts.view_deg / steps;
  const double view_deg = facts.step_deg ? steps * step_deg : *facts.view_deg;
  if (view_deg > 360.0) return std::nullopt;
  return in_radians(-0.5 * view_deg, step_deg);
}

std::string known_beam_counts() {
  std::string all;
  for (const KnownScanner& known : kKnown) all += fmt::format("{}{}", all.empty() ? "" : ", ", known.beams);
  return all;
}

}  // namespace topo::bench
