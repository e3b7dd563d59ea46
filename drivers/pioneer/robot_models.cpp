// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/pioneer/robot_models.hpp"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <numbers>

namespace topo::pioneer {
namespace {

struct SonarMm {
  double x, y, degrees;
};

using Sonars = std::array<types::Se2, RobotModel::kSonars>;

Sonars to_metres(const std::array<SonarMm, RobotModel::kSonars>& table) {
  Sonars out;
  std::transform(table.begin(), table.end(), out.begin(), [](const SonarMm& s) {
    return types::Se2{s.x * 1e-3, s.y * 1e-3, s.degrees * types::kDegree_rad};
  });
  return out;
}

Sonars p3dx_sonars() {
  return to_metres({{{69, 136, 90},
                     {114, 119, 50},
                     {148, 78, 30},
                     {166, 27, 10},
                     {166, -27, -10},
                     {148, -78, -30},
                     {114, -119, -50},
                     {69, -136, -90},
                     {-157, -136, -90},
                     {-203, -119, -130},
                     {-237, -78, -150},
                     {-255, -27, -170},
                     {-255, 27, 170},
                     {-237, 78, 150},
                     {-203, 119, 130},
                     {-157, 136, 90}}});
}

Sonars p3at_sonars() {
  return to_metres({{{147, 136, 90},
                     {193, 119, 50},
                     {227, 79, 30},
                     {245, 27, 10},
                     {245, -27, -10},
                     {227, -79, -30},
                     {193, -119, -50},
                     {147, -136, -90},
                     {-144, -136, -90},
                     {-189, -119, -130},
                     {-223, -79, -150},
                     {-241, -27, -170},
                     {-241, 27, 170},
                     {-223, 79, 150},
                     {-189, 119, 130},
                     {-144, 136, 90}}});
}

RobotModel make_dx(std::string_view subclass, double mm_per_count, double mm_per_sonar_unit = 1.0) {
  return {.subclass = subclass,
          .chassis = "p3dx",
          .mm_per_count = mm_per_count,
          .mm_per_sonar_unit = mm_per_sonar_unit,
          .radps_per_mmps = 0.0056,
          .size = types::kP3dx,
          .T_base_sonar = p3dx_sonars()};
}

RobotModel make_at(std::string_view subclass, double mm_per_count, double mm_per_sonar_unit = 1.0) {
  return {.subclass = subclass,
          .chassis = "p3at",
          .mm_per_count = mm_per_count,
          .mm_per_sonar_unit = mm_per_sonar_unit,
          .radps_per_mmps = 0.0034,
          .size = types::kP3at,
          .T_base_sonar = p3at_sonars()};
}

/// PROTOCOLS section 6.1, board by board: SH-2, H8S, C166.
const std::array<RobotModel, 9>& models() {
  constexpr double kOldSonar = 0.268;
  static const std::array<RobotModel, 9> kModels{
      make_dx("p3dx-sh", 1.0),  make_at("p3at-sh", 1.0),          make_at("p3atiw-sh", 1.0),
      make_dx("p3dx", 0.485),   make_at("p3at", 0.465),           make_dx("p2d8+", 0.485),
      make_at("p2at8+", 0.465), make_dx("p2dx", 0.84, kOldSonar), make_at("p2at", 1.32, kOldSonar)};
  return kModels;
}

constexpr std::string_view kNewBoard = "-sh";

bool equal_ignoring_case(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

}  // namespace

double radians_per_heading_unit() { return 2.0 * std::numbers::pi / kHeadingUnits; }

const RobotModel* find_model(std::string_view subclass) {
  const auto& all = models();
  const auto found = std::find_if(
      all.begin(), all.end(), [&](const RobotModel& m) { return equal_ignoring_case(m.subclass, subclass); });
  return found == all.end() ? nullptr : &*found;
}

const RobotModel* find_family(std::string_view subclass) {
  if (const RobotModel* exact = find_model(subclass)) return exact;
  const auto& all = models();
  const auto found = std::find_if(all.begin(), all.end(), [&](const RobotModel& m) {
    const std::size_t size = m.subclass.size();
    return m.subclass.ends_with(kNewBoard) && subclass.size() > size + 1 && subclass[size] == '-' &&
           equal_ignoring_case(m.subclass, subclass.substr(0, size));
  });
  return found == all.end() ? nullptr : &*found;
}

std::string assumption(std::string_view subclass, const RobotModel& family) {
  const bool own = family.subclass == "p3dx-sh" || family.subclass == "p3at-sh";
  if (own && equal_ignoring_case(subclass, family.subclass)) return {};
  std::array<char, 160> text{};
  std::snprintf(text.data(), text.size(), "\" is driven as %.*s: %g mm a count, track %.3f m, hull of a %.*s",
                static_cast<int>(family.subclass.size()), family.subclass.data(), family.mm_per_count,
                2e-3 / family.radps_per_mmps, static_cast<int>(family.chassis.size()), family.chassis.data());
  return "\"" + std::string(subclass) + text.data();
}

std::string known_families() {
  std::string out;
  for (const RobotModel& m : models()) out.append(out.empty() ? "" : ", ").append(m.subclass);
  return out;
}

}  // namespace topo::pioneer
