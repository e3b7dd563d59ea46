// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/pioneer/robot_models.hpp"

#include <algorithm>
#include <cctype>
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

RobotModel make_dx(std::string_view subclass, double mm_per_count) {
  return {.subclass = subclass,
          .mm_per_count = mm_per_count,
          .radps_per_mmps = 0.0056,
          .size = types::kP3dx,
          .T_base_sonar = p3dx_sonars()};
}

RobotModel make_at(std::string_view subclass, double mm_per_count) {
  return {.subclass = subclass,
          .mm_per_count = mm_per_count,
          .radps_per_mmps = 0.0034,
          .size = types::kP3at,
          .T_base_sonar = p3at_sonars()};
}

const std::array<RobotModel, 4>& models() {
  static const std::array<RobotModel, 4> kModels{make_dx("p3dx-sh", 1.0), make_at("p3at-sh", 1.0),
                                                 make_dx("p3dx", 0.485), make_at("p3at", 0.465)};
  return kModels;
}

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

std::string known_subclasses() {
  std::string out;
  for (const RobotModel& m : models()) out.append(out.empty() ? "" : ", ").append(m.subclass);
  return out;
}

}  // namespace topo::pioneer
