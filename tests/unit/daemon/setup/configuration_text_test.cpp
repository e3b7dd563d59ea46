// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/setup/configuration_text.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "daemon/config/load.hpp"

namespace topo::daemon {
namespace {

std::string text_of(const std::vector<std::string>& pieces) { return *rc::gen::elementOf(pieces); }
double metres(double most) { return *rc::gen::inRange(-1000, 1001) * 1e-3 * most; }

ScannerConfig any_scanner(const char* address, const char* serial_number) {
  ScannerConfig scanner;
  scanner.present = true;
  scanner.address = address;
  scanner.serial_number = serial_number;
  scanner.x_m = metres(1.0);
  scanner.y_m = metres(1.0);
  scanner.z_m = std::abs(metres(3.0));
  scanner.mirrored = *rc::gen::arbitrary<bool>();
  return scanner;
}

Configuration any_wanted(RobotModel model) {
  Configuration wanted = parse_configuration(first_configuration(model), "").values;
  wanted.robot.name = text_of({"dx-1", "A", "pioneer_7"});
  wanted.base.address = text_of({"serial:/dev/ttyUSB3", "tcp:10.0.0.1:8101", "can:can0:3"});
  wanted.base.name = text_of({"", "MobileRobot", "he said \"no\"", "a # b", "back\\slash"});
  wanted.base.serial_number = text_of({"", "MR_1", "0123"});
  wanted.front = any_scanner("tcp:192.168.0.10:10940", "H0902680");
  wanted.front.yaw_rad = metres(1.3);
  wanted.coronal = any_scanner("serial:/dev/ttyACM1", "H0902681");
  wanted.coronal.roll_rad = metres(3.14);
  wanted.coronal.present = *rc::gen::arbitrary<bool>();
  return wanted;
}

RC_GTEST_PROP(SetupText, ReadsBackAsWhatWasWanted, ()) {
  const RobotModel model = *rc::gen::element(RobotModel::kP3dx, RobotModel::kP3at);
  const Configuration wanted = any_wanted(model);
  // On the example, and on what setup itself has written before.
  std::string text = first_configuration(model);
  if (*rc::gen::arbitrary<bool>()) text = configuration_text(text, any_wanted(model));
  text = configuration_text(text, wanted);
  const LoadedConfiguration loaded = parse_configuration(text, "f.toml");
  RC_ASSERT(faults_text(loaded) == "");
  const Configuration& got = loaded.values;
  RC_ASSERT(got.robot.name == wanted.robot.name);
  RC_ASSERT(got.robot.model == model);
  RC_ASSERT(got.base.address == wanted.base.address);
  RC_ASSERT(got.base.name == wanted.base.name);
  RC_ASSERT(got.base.serial_number == wanted.base.serial_number);
  RC_ASSERT(got.coronal.present == wanted.coronal.present);
  const auto same = [](const ScannerConfig& a, const ScannerConfig& b) {
    return a.address == b.address && a.serial_number == b.serial_number && a.x_m == b.x_m && a.y_m == b.y_m &&
           a.z_m == b.z_m && a.yaw_rad == b.yaw_rad && a.roll_rad == b.roll_rad && a.mirrored == b.mirrored;
  };
  RC_ASSERT(same(got.front, wanted.front));
  if (wanted.coronal.present) RC_ASSERT(same(got.coronal, wanted.coronal));
  RC_ASSERT(configuration_text(text, wanted) == text);  // nothing is left to do
}

TEST(SetupText, KeepsWhatElseAFileSays) {
  const std::string before =
      "[robot]\nname = \"a\"\nmodel = \"p3dx\"\n[base]\naddress = \"/dev/ttyUSB0\"\nv_max_mps = 0.3\n"
      "[scanner.front]\naddress = \"/dev/ttyACM0\"\n[area]\nkeep_out_m = [[[1, 1], [2, 1], [2, 2]]]  # "
      "stairs\n";
  Configuration wanted = parse_configuration(before, "").values;
  wanted.front.serial_number = "H1";
  const std::string after = configuration_text(before, wanted);
  EXPECT_NE(after.find("v_max_mps = 0.3\n"), std::string::npos);
  EXPECT_NE(after.find("# stairs"), std::string::npos);
  EXPECT_NE(after.find("[scanner.front]\naddress = \"/dev/ttyACM0\"\nserial_number = \"H1\"\n"),
            std::string::npos);
}

TEST(SetupText, ACoronalScannerThatIsGoneIsCommentedOut) {
  const std::string before = first_configuration(RobotModel::kP3dx);
  Configuration wanted = parse_configuration(before, "").values;
  wanted.coronal.present = false;
  const std::string after = configuration_text(before, wanted);
  EXPECT_FALSE(parse_configuration(after, "").values.coronal.present);
  EXPECT_NE(after.find("# [scanner.coronal]"), std::string::npos);
  EXPECT_NE(after.find("\n[mapping]"), std::string::npos);
}

TEST(SetupText, TheExamplesAreThoseOfTheirModel) {
  for (const RobotModel model : {RobotModel::kP3dx, RobotModel::kP3at}) {
    const LoadedConfiguration loaded = parse_configuration(first_configuration(model), "");
    EXPECT_EQ(faults_text(loaded), "");
    EXPECT_EQ(loaded.values.robot.model, model);
    EXPECT_EQ(first_configuration(model).find("UTM-30LX"), std::string::npos)
        << "says of one robot's scanners";
  }
}

}  // namespace
}  // namespace topo::daemon
