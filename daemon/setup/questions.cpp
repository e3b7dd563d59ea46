// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <iterator>

#include "daemon/setup/dialogue.hpp"
#include "drivers/pioneer/robot_models.hpp"

namespace topo::daemon {
namespace {

Question base_question(const SetupState& state) {
  std::string text = "Which base is this robot's?\n";
  for (std::size_t i = 0; i < state.found.bases.size(); ++i) {
    const FoundBase& base = state.found.bases[i];
    fmt::format_to(std::back_inserter(text), "  {}: {}, {} \"{}\"\n", i + 1, base.address, base.subclass,
                   base.name);
  }
  return {text + "Its number", "1", false};
}

Question look(std::string text) { return {std::move(text) + " Enter when it is so", "ready", true}; }

std::string numbers(double a, double b, double c) { return fmt::format("{:g} {:g} {:g}", a, b, c); }

Question place_question(const char* scanner, const ScannerConfig& values) {
  return {fmt::format(
              "Where is the {} scanner: metres ahead of the middle of the wheels' axle (P3-AT: of the four "
              "wheels), to the left of it, above the floor?",
              scanner),
          numbers(values.x_m, values.y_m, values.z_m), false};
}

Question hull_question(const SetupState& state) {
  const RobotConfig& robot = state.values.robot;
  const types::ModelSize model = model_size(robot.model);
  return {fmt::format(
              "How far does the robot reach ahead of that point and behind it, and how wide is it, with all "
              "that is bolted on? 0: as the {} is sold, {:g} {:g} {:g} m",
              model_name(robot.model), model.front_m, model.rear_m, model.width_m),
          numbers(robot.length_front_m, robot.length_rear_m, robot.width_m), false};
}

}  // namespace

Question question(const SetupState& state) {
  switch (state.ask) {
    case Ask::kBase:
      return base_question(state);
    case Ask::kFamily:
      return {fmt::format("This base names itself after no known board. Whose factors hold? One of {}",
                          pioneer::known_families()),
              state.values.base.family.empty() ? "p3dx-sh" : state.values.base.family, false};
    case Ask::kName:
      return {"What is the robot called? Letters, digits, - and _", state.values.robot.name, false};
    case Ask::kAway:
      return look("Let nobody be within 3 m of the robot.");
    case Ask::kAhead:
      return look("Stand 1 m before the robot, straight ahead of it.");
    case Ask::kLeft:
      return look("Stand 1 m to the left of the robot, beside its scanners.");
    case Ask::kFront:
      return place_question("level", state.values.front);
    case Ask::kCoronal:
      return place_question("upright", state.values.coronal);
    case Ask::kHull:
      return hull_question(state);
    case Ask::kWrite:
      return {fmt::format("Write this into {}? The file of before is kept. y or n", state.file), "y", false};
  }
  return {};
}

}  // namespace topo::daemon
