// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <cstdio>
#include <filesystem>
#include <fstream>

#include "daemon/config/consistency.hpp"
#include "daemon/config/suggest.hpp"
#include "tests/unit/daemon/config/sample.hpp"

namespace topo::daemon {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;
using ::testing::UnorderedElementsAre;

std::string with(std::string_view more) { return std::string(kSmallest) + std::string(more); }

TEST(Configuration, SmallestHasNoFaultAndTheDefaults) {
  const auto loaded = parse_configuration(kSmallest, "f.toml");
  EXPECT_THAT(loaded.faults, IsEmpty());
  EXPECT_EQ(loaded.values.base.address, "tcp:localhost:8101");
  EXPECT_EQ(loaded.values.base.v_max_mps, BaseConfig{}.v_max_mps);
  EXPECT_TRUE(loaded.values.front.present);
  EXPECT_FALSE(loaded.values.coronal.present);
}

TEST(Configuration, TakesEveryKindOfValue) {
  const auto loaded = parse_configuration(with(R"(x_m = 1
intensity = true
skip_scans = 2
[control]
socket = "/tmp/s"
[log]
level = "warning"
[realtime]
policy = "off"
cpus = [0, 1]
)"),
                                          "f.toml");
  ASSERT_THAT(loaded.faults, IsEmpty());
  EXPECT_EQ(loaded.values.front.x_m, 1.0);
  EXPECT_TRUE(loaded.values.front.intensity);
  EXPECT_EQ(loaded.values.front.skip_scans, 2);
  EXPECT_EQ(loaded.values.control.socket, "/tmp/s");
  EXPECT_EQ(loaded.values.log.level, LogLevel::kWarning);
  EXPECT_EQ(loaded.values.realtime.policy, RealtimePolicy::kOff);
  EXPECT_THAT(loaded.values.realtime.cpus, ElementsAre(0, 1));
}

TEST(Configuration, AllFaultsAtOnceWithTheirPlaces) {
  const auto faults = faults_of(R"([robot]
modle = "p3dx"
id = 0
[base]
adress = "serial:/dev/ttyUSB0"
v_max_mps = "fast"
sonar = 1
[scanner.front]
address = "tcp:localhost"
  x_m = nan
skip_scans = 1.5
[lgo]
level = "info"
[realtime]
policy = "maybe"
cpus = [0, -1]
)");
  EXPECT_THAT(
      faults,
      ElementsAre(
          StartsWith("1:2: robot.model is missing, expected one of \"p3dx\", \"p3at\""),
          "2:1: \"robot.modle\": unknown key, did you mean robot.model?",
          "3:6: robot.id: found 0, expected a whole number from 1 to 250",
          StartsWith("4:2: base.address is missing, expected \"serial:"),
          "5:1: \"base.adress\": unknown key, did you mean base.address?",
          "6:13: base.v_max_mps: found \"fast\", expected a number from 0.05 to 2 (m/s)",
          "7:9: base.sonar: found 1, expected true or false",
          StartsWith(
              "9:11: scanner.front.address: device address \"tcp:localhost\": the port is missing; expected"),
          "10:9: scanner.front.x_m: found nan, expected a number from -1 to 1 (m)",
          "11:14: scanner.front.skip_scans: found 1.5, expected a whole number from 0 to 9",
          "12:2: \"lgo\": unknown section, did you mean log?",
          "15:10: realtime.policy: found \"maybe\", expected one of \"enforce\", \"try\", \"off\"",
          "16:8: realtime.cpus: found a list of 2 values, expected a list of whole numbers from 0 to 1023: "
          "found there -1"));
}

TEST(Configuration, TheFamilyOfTheBaseIsOneOfItsModel) {
  const auto faults = [](const char* model, const char* family) {
    return faults_of(std::string("[robot]\nmodel = \"") + model +
                     "\"\n[base]\naddress = \"tcp:localhost:8101\"\nfamily = \"" + family +
                     "\"\n[scanner.front]\naddress = \"tcp:localhost:10940\"\n");
  };
  EXPECT_THAT(faults("p3dx", "p3dx-sh"), IsEmpty());
  EXPECT_THAT(faults("p3at", "p3atiw-sh"), IsEmpty());
  EXPECT_THAT(
      faults("p3dx", "p3at"),
      ElementsAre("5:1: base.family contradicts robot.model (line 2): found \"p3at\", which is a p3at"));
  EXPECT_THAT(faults("p3dx", "seekur"),
              ElementsAre(StartsWith("5:10: base.family: found \"seekur\", expected a string: p3dx-sh, ")));
}

TEST(Configuration, MasksOfTheFrontScannerLeaveWhatBrakingNeeds) {
  const auto faults = [](const char* masks) {
    return faults_of(with(std::string("masks_deg = ") + masks + "\n"));
  };
  for (const char* good : {"[]", "[[38, 44], [-44, -38]]", "[[100, 130], [-130, -100]]", "[[16, 26]]",
                           "[[170, 190]]", "[[55, 75]]"})
    EXPECT_THAT(faults(good), IsEmpty()) << good;
  for (const auto& [bad, said] :
       {std::pair{"[[-5, 5]]", "within 15 degrees of straight ahead"},
        {"[[355, 359]]", "within 15 degrees of straight ahead"},
        {"[[30, 41]]", "11 degrees of it are in the sector that braking needs"},
        {"[[40, 80]]", "20 degrees of it are in the sector"},
        {"[[20, 30], [31, 41], [-30, -20], [-40, -39]]", "found 31 degrees together"},
        {"[[44, 38]]", "expected at most 8 sectors"},
        {"[[0, 360]]", "expected at most 8 sectors"},
        {"[40, 44]", "expected at most 8 sectors"},
        {"[[40, nan]]", "expected at most 8 sectors"}}) {
    const auto found = faults(bad);
    ASSERT_EQ(found.size(), 1U) << bad;
    EXPECT_THAT(found[0], HasSubstr(said)) << bad;
    EXPECT_THAT(found[0], HasSubstr("scanner.front.masks_deg")) << bad;
  }
}

TEST(Configuration, AFrontScannerIsUprightOrUpsideDown) {
  const auto read = [](const char* keys) { return parse_configuration(with(keys), "f.toml"); };
  EXPECT_FALSE(is_upside_down(read("").values.front));
  EXPECT_TRUE(is_upside_down(read("mirrored = true\n").values.front));
  EXPECT_TRUE(is_upside_down(read("roll_rad = 3.1416\n").values.front));
  EXPECT_FALSE(is_upside_down(read("roll_rad = -3.1416\nmirrored = true\n").values.front));
  EXPECT_THAT(read("roll_rad = 0.05\n").faults, IsEmpty());
  const auto tilted = read("roll_rad = 1.57\n");
  ASSERT_EQ(tilted.faults.size(), 1U);
  EXPECT_THAT(tilted.faults[0].message, HasSubstr("expected 0 (upright) or 3.1416 (upside down)"));
}

TEST(Configuration, MasksReadBackAsTheyArePrinted) {
  const auto loaded = parse_configuration(with("masks_deg = [[38.1, 44.7], [-130, -100]]\n"), "f.toml");
  ASSERT_THAT(loaded.faults, IsEmpty());
  EXPECT_EQ(loaded.values.front.masks.count, 2U);
  const auto again = parse_configuration(effective_text(loaded), "g.toml");
  EXPECT_THAT(again.faults, IsEmpty());
  EXPECT_EQ(again.values.front.masks, loaded.values.front.masks);
  EXPECT_EQ(control_params(loaded.values).perception.stop_zone.masks, loaded.values.front.masks);
}

TEST(Configuration, SyntaxFaultsDoNotHideTheOthers) {
  const auto faults = faults_of(R"([robot]
model =
id = 7 7
name = "a b"
[base]
address = "tcp:localhost:8101"
address = "tcp:localhost:8102"
[scanner.front]
address = "tcp:localhost:10940"
)");
  ASSERT_EQ(faults.size(), 4U) << ::testing::PrintToString(faults);
  EXPECT_THAT(faults[0], StartsWith("2:"));
  EXPECT_THAT(faults[1], StartsWith("3:"));
  EXPECT_THAT(faults[2], StartsWith("4:8: robot.name: found \"a b\", expected a string"));
  EXPECT_THAT(faults[3], StartsWith("7:"));
  EXPECT_THAT(faults[3], HasSubstr("address"));
}

TEST(Configuration, BrokenHeaderEndsTheReading) {
  const auto loaded = parse_configuration("[robot\nmodel = 3\n", "f.toml");
  ASSERT_EQ(loaded.faults.size(), 1U);
  EXPECT_EQ(loaded.faults[0].place.line, 1);
}

TEST(Configuration, SectionThatIsNone) {
  EXPECT_THAT(faults_of("base = 3\n" +
                        std::string("[robot]\nmodel = \"p3dx\"\n[scanner.front]\naddress = \"/dev/a\"\n")),
              UnorderedElementsAre("1:1: base: found 3, expected a section [base]",
                                   HasSubstr("base.address is missing")));
}

TEST(Configuration, EmptyFileNamesWhatMustBeThere) {
  EXPECT_THAT(faults_of(""), ElementsAre(StartsWith("1:1: base.address is missing"),
                                         StartsWith("1:1: robot.model is missing"),
                                         StartsWith("1:1: scanner.front.address is missing")));
}

TEST(Configuration, ContradictoryAddresses) {
  EXPECT_THAT(faults_of(with("[scanner.coronal]\naddress = \"tcp:localhost:10940\"\n")),
              ElementsAre("8:1: scanner.coronal.address contradicts scanner.front.address (line 6): both are "
                          "tcp:localhost:10940; every device has an address of its own"));
}

TEST(Configuration, SameDeviceWrittenInTwoWays) {
  const auto faults = faults_of(
      "[robot]\nmodel = \"p3dx\"\n[base]\naddress = \"/dev/ttyUSB0\"\n[scanner.front]\naddress = "
      "\"serial:/dev/ttyUSB0\"\n");
  EXPECT_THAT(faults, ElementsAre(HasSubstr("scanner.front.address contradicts base.address (line 4)")));
}

TEST(Configuration, ScannersOfOneAddressWrittenInTwoWays) {
  EXPECT_THAT(
      faults_of(with("[scanner.coronal]\naddress = \"tcp:LocalHost:10940\"\n")),
      ElementsAre(StartsWith("8:1: scanner.coronal.address contradicts scanner.front.address (line 6)")));
  EXPECT_THAT(
      faults_of("[robot]\nmodel = \"p3dx\"\n[base]\naddress = \"/dev/ttyUSB0\"\n[scanner.front]\naddress = "
                "\"/dev/ttyACM0\"\nserial_number = \"H1\"\n[scanner.coronal]\naddress = "
                "\"serial:/dev/serial/..//ttyACM0\"\nserial_number = \"H2\"\n"),
      ElementsAre(
          StartsWith("9:1: scanner.coronal.address contradicts scanner.front.address (line 6): both are "
                     "/dev/ttyACM0")));
}

TEST(Configuration, NameAndSerialNumberOfTheBase) {
  const std::string_view text =
      "[robot]\nmodel = \"p3dx\"\n[base]\naddress = \"can:can0:0\"\nname = \"Old Joe 2\"\nserial_number = "
      "\"SB0123\"\n[scanner.front]\naddress = \"tcp:h:1\"\n";
  const auto loaded = parse_configuration(text, "f.toml");
  ASSERT_THAT(loaded.faults, IsEmpty());
  EXPECT_EQ(loaded.values.base.name, "Old Joe 2");
  EXPECT_EQ(loaded.values.base.serial_number, "SB0123");
  EXPECT_THAT(effective_text(loaded), HasSubstr("serial_number = \"SB0123\""));
  EXPECT_THAT(faults_of("[robot]\nmodel = \"p3dx\"\n[base]\naddress = \"can:can0:0\"\nserial_number = "
                        "\"a\\tb\"\nname = 7\n[scanner.front]\naddress = \"tcp:h:1\"\n"),
              ElementsAre(StartsWith("5:17: base.serial_number: found"),
                          StartsWith("6:8: base.name: found 7, expected a string: up to 32 printable")));
}

TEST(Configuration, AFrontScannerThatDoesNotLookAhead) {
  EXPECT_THAT(
      faults_of(with("yaw_rad = 3.14\n")),
      ElementsAre("7:1: scanner.front.yaw_rad: found 3.14 (180 degrees): a scanner with 270 degrees of "
                  "view (UTM-30LX) then sees 30 of the 120 degrees ahead that braking needs (60 to either "
                  "side), and the robot would drive blind; expected -1.308 to 1.308 (75 degrees either "
                  "way)"));
  EXPECT_THAT(faults_of(with("yaw_rad = -1.4\n")), ElementsAre(HasSubstr("sees 114 of the 120 degrees")));
  EXPECT_THAT(faults_of(with("yaw_rad = 1.308\n")), IsEmpty());
  EXPECT_THAT(faults_of(with("yaw_rad = -1.308\n")), IsEmpty());
}

TEST(Configuration, ContradictorySerialNumbers) {
  EXPECT_THAT(
      faults_of(with("serial_number = \"H0902680\"\n[scanner.coronal]\naddress = \"tcp:localhost:10941\"\n"
                     "serial_number = \"00902680\"\n")),
      ElementsAre(StartsWith(
          "10:1: scanner.coronal.serial_number contradicts scanner.front.serial_number (line 7)")));
}

TEST(Configuration, TwoSensorsOnSerialDevicesNeedSerialNumbers) {
  const auto faults = faults_of(
      "[robot]\nmodel = \"p3dx\"\n[base]\naddress = \"/dev/ttyUSB0\"\n[scanner.front]\naddress = "
      "\"/dev/ttyACM0\"\n"
      "[scanner.coronal]\naddress = \"/dev/ttyACM1\"\nserial_number = \"H1\"\n");
  EXPECT_THAT(faults, ElementsAre(StartsWith("6:1: scanner.front.serial_number is missing")));
}

TEST(Configuration, FootprintAndSpeedAgainstTheModel) {
  const auto faults = faults_of(
      "[robot]\nmodel = \"p3at\"\nwidth_m = 0.4\nlength_front_m = 0.4\n[base]\naddress = "
      "\"/dev/ttyUSB0\"\nv_max_mps = 1.0\n"
      "[scanner.front]\naddress = \"/dev/ttyACM0\"\n");
  EXPECT_THAT(
      faults,
      ElementsAre(
          StartsWith("3:1: robot.width_m contradicts robot.model (line 2): found 0.4"),
          StartsWith("7:1: base.v_max_mps contradicts robot.model (line 2): found 1, a P3-AT does at most")));
}

TEST(Configuration, BaseThreadGoesBeforeScanThreads) {
  EXPECT_THAT(
      faults_of(with("[realtime]\nscan_priority = 50\n")),
      ElementsAre(StartsWith("8:1: realtime.scan_priority contradicts realtime.base_priority (by default)")));
}

TEST(Configuration, FileThatCannotBeRead) {
  const auto missing = load_configuration("/nonexistent/topometric.toml");
  ASSERT_FALSE(missing.has_value());
  EXPECT_EQ(missing.error().code, types::Errc::kNotFound);
  EXPECT_THAT(missing.error().message, HasSubstr("/nonexistent/topometric.toml: No such file"));
  const auto directory = load_configuration("/");
  EXPECT_FALSE(directory.has_value());
}

TEST(Configuration, FaultsTextHasFileLineColumn) {
  const auto loaded = parse_configuration(with("skip_scans = 10\n"), "dir/f.toml");
  EXPECT_EQ(faults_text(loaded),
            "dir/f.toml:7:14: scanner.front.skip_scans: found 10, expected a whole number from 0 to 9\n");
}

TEST(Suggest, NearWordsOnly) {
  const std::string_view keys[] = {"v_max_mps", "omega_max_radps", "address"};
  EXPECT_EQ(nearest("v_max", keys), "v_max_mps");
  EXPECT_EQ(nearest("addres", keys), "address");
  EXPECT_EQ(nearest("adrdess", keys), "address");
  EXPECT_EQ(nearest("colour", keys), "");
  EXPECT_EQ(nearest("", keys), "");
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3U);
  EXPECT_EQ(edit_distance("ab", "ba"), 1U);
}

TEST(SerialNumber, LeadingZeroEqualsH) {
  EXPECT_EQ(normal_serial_number("00902680"), normal_serial_number("h0902680"));
  EXPECT_NE(normal_serial_number("H0902680"), normal_serial_number("H0902681"));
}

}  // namespace
}  // namespace topo::daemon
