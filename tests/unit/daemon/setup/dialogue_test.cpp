// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/setup/dialogue.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <map>

#include "daemon/config/load.hpp"
#include "daemon/setup/configuration_text.hpp"
#include "tests/bench/topobench/calibrate/standing.hpp"

namespace topo::daemon {
namespace {

using Pictures = std::vector<calibration::StillPicture>;

constexpr const char* kFile = "robot.toml";

FoundBase base(const char* address, const char* chassis = "p3dx") {
  return {address, "MobileRobot 7", "p3dx-sh", "MR_1", chassis, 2000};
}

Found two_scanners() {
  return {{{"serial:/dev/ttyACM0", "UTM-30LX", "H1"}, {"serial:/dev/ttyACM1", "UTM-30LX", "H2"}},
          {base("serial:/dev/ttyUSB0")},
          {}};
}

/// What the scanners see at each question that looks, of a robot whose second scanner is the level one.
struct Room {
  bench::Standing robot;

  [[nodiscard]] Pictures at(Ask ask) const {
    const std::vector<sim::Vector2> people = ask == Ask::kAhead  ? std::vector<sim::Vector2>{{1.2, 0.0}}
                                             : ask == Ask::kLeft ? std::vector<sim::Vector2>{{0.1, 1.1}}
                                                                 : std::vector<sim::Vector2>{};
    Pictures seen = robot.both(people);
    std::swap(seen[0], seen[1]);
    return seen;
  }
};

/// The room's pictures are cast once.
const Pictures& pictures_at(Ask ask) {
  static const std::map<Ask, Pictures> kSeen = [] {
    Room room;
    room.robot.level.mirrored = true;
    room.robot.upright.roll_rad = 0.1;
    std::map<Ask, Pictures> out;
    for (const Ask a : {Ask::kAway, Ask::kAhead, Ask::kLeft}) out[a] = room.at(a);
    return out;
  }();
  const auto found = kSeen.find(ask);
  static const Pictures kNone;
  return found == kSeen.end() ? kNone : found->second;
}

SetupState answer(SetupState state, const std::string& text) {
  const Ask ask = state.ask;
  return answered(std::move(state), text, pictures_at(ask));
}

/// Enter to everything that is asked.
SetupState with_defaults(SetupState state) {
  while (!state.end) state = answer(std::move(state), "");
  return state;
}

/// Enter until `ask` is asked.
SetupState until(SetupState state, Ask ask) {
  while (!state.end && state.ask != ask) state = answer(std::move(state), "");
  return state;
}

TEST(SetupDialogue, EnterAloneMakesAConfiguration) {
  const SetupState end = with_defaults(begin_setup(two_scanners(), kFile, std::nullopt));
  ASSERT_EQ(end.end, SetupEnd::kAgreed) << end.remark;
  EXPECT_EQ(end.answers, 8);
  const auto loaded = parse_configuration(configuration_text(end.text, end.values), kFile);
  EXPECT_EQ(faults_text(loaded), "");
  const Configuration& got = loaded.values;
  EXPECT_EQ(got.robot.name, "MobileRobot_7");
  EXPECT_EQ(got.base.name, "MobileRobot 7");
  EXPECT_EQ(got.base.serial_number, "MR_1");
  EXPECT_EQ(got.front.serial_number, "H2");
  EXPECT_EQ(got.front.address, "serial:/dev/ttyACM1");
  EXPECT_TRUE(got.front.mirrored);
  EXPECT_EQ(got.front.yaw_rad, 0.0);
  EXPECT_EQ(got.coronal.serial_number, "H1");
  EXPECT_FALSE(got.coronal.mirrored);
  EXPECT_NEAR(got.coronal.roll_rad, 0.1, 0.02);
  EXPECT_NEAR(got.coronal.z_m, 0.4, 0.02);
}

TEST(SetupDialogue, OneScannerIsTheLevelOne) {
  Found found = two_scanners();
  found.scanners.erase(found.scanners.begin());
  SetupState state = begin_setup(std::move(found), kFile, std::nullopt);
  while (!state.end) {
    const Ask ask = state.ask;
    EXPECT_NE(ask, Ask::kCoronal);
    Pictures seen = pictures_at(ask);
    if (!seen.empty()) seen.erase(seen.begin());
    state = answered(std::move(state), "", seen);
  }
  ASSERT_EQ(state.end, SetupEnd::kAgreed) << state.remark;
  EXPECT_FALSE(
      parse_configuration(configuration_text(state.text, state.values), kFile).values.coronal.present);
}

TEST(SetupDialogue, WithoutDevicesNothingIsAsked) {
  Found no_base = two_scanners();
  no_base.bases.clear();
  const SetupState without_base = begin_setup(no_base, kFile, std::nullopt);
  EXPECT_EQ(without_base.end, SetupEnd::kRefused);
  EXPECT_NE(without_base.remark.find("no base was found"), std::string::npos);
  Found no_scanner = two_scanners();
  no_scanner.scanners.clear();
  EXPECT_NE(begin_setup(no_scanner, kFile, std::nullopt).remark.find("no scanner was found"),
            std::string::npos);
  Found three = two_scanners();
  three.scanners.push_back({"tcp:10.0.0.1:10940", "UST-10LX", "H3"});
  EXPECT_NE(begin_setup(three, kFile, std::nullopt).remark.find("found 3 scanners"), std::string::npos);
}

TEST(SetupDialogue, AFileWithFaultsOfItsOwnIsNotTouched) {
  const std::string text = "[robot]\nmodel = \"p3dx\"\n[area]\nkeep_out = []\n";
  const SetupState state = begin_setup(two_scanners(), kFile, text);
  EXPECT_EQ(state.end, SetupEnd::kRefused);
  EXPECT_NE(state.remark.find("robot.toml:4:"), std::string::npos) << state.remark;
}

TEST(SetupDialogue, FaultsThatItCuresAreNone) {
  const SetupState state = begin_setup(two_scanners(), kFile, "[robot]\nmodel = \"p3dx\"\nname = \"old\"\n");
  EXPECT_FALSE(state.end) << state.remark;
  EXPECT_EQ(question(state).otherwise, "old");
}

TEST(SetupDialogue, OneOfSeveralBasesIsChosen) {
  Found found = two_scanners();
  found.bases.push_back(base("can:can0:2", "p3at"));
  SetupState state = begin_setup(std::move(found), kFile, std::nullopt);
  ASSERT_EQ(state.ask, Ask::kBase);
  state = answer(std::move(state), "3");
  EXPECT_EQ(state.ask, Ask::kBase);
  EXPECT_EQ(state.remark, "found \"3\", expected the number of a base, 1 to 2.");
  state = answer(std::move(state), "2");
  EXPECT_EQ(state.ask, Ask::kName);
  EXPECT_EQ(state.values.base.address, "can:can0:2");
  EXPECT_EQ(state.values.robot.model, RobotModel::kP3at);
}

TEST(SetupDialogue, ABaseOfNoKnownBoardIsGivenOne) {
  Found found = two_scanners();
  found.bases.front().chassis.clear();
  SetupState state = begin_setup(std::move(found), kFile, std::nullopt);
  ASSERT_EQ(state.ask, Ask::kFamily);
  state = answer(std::move(state), "p4dx");
  EXPECT_NE(state.remark.find("found \"p4dx\", expected one of p3dx-sh"), std::string::npos);
  state = answer(std::move(state), "p3at");
  EXPECT_EQ(state.values.base.family, "p3at");
  EXPECT_EQ(state.values.robot.model, RobotModel::kP3at);
}

TEST(SetupDialogue, NonsenseIsRefusedWithWhatWouldBeRight) {
  struct Case {
    Ask ask;
    const char* answer;
    const char* said;
  };
  for (const Case& c :
       {Case{Ask::kName, "two words", "1 to 32 letters, digits, - and _"},
        Case{Ask::kAway, "yes", "the Enter key alone"}, Case{Ask::kFront, "0.1 0", "expected three numbers"},
        Case{Ask::kFront, "0.1 0 nan", "expected three numbers"},
        Case{Ask::kFront, "0.1 0 0.3m", "expected three numbers"},
        Case{Ask::kFront, "21 0 0.3", "from -1 to 1"}, Case{Ask::kCoronal, "0 0 -1", "from 0 to 3"},
        Case{Ask::kHull, "0.1 0 0", "or more than that"}, Case{Ask::kWrite, "maybe", "expected y or n"}}) {
    const SetupState before = until(begin_setup(two_scanners(), kFile, std::nullopt), c.ask);
    ASSERT_EQ(before.ask, c.ask);
    const SetupState after = answer(before, c.answer);
    EXPECT_EQ(after.ask, c.ask) << c.answer;
    EXPECT_FALSE(after.end);
    EXPECT_NE(after.remark.find(c.said), std::string::npos) << c.answer << ": " << after.remark;
    EXPECT_EQ(configuration_text(after.text, after.values), configuration_text(before.text, before.values));
  }
}

TEST(SetupDialogue, AScannerThatSendsNothingIsNamed) {
  const SetupState state = until(begin_setup(two_scanners(), kFile, std::nullopt), Ask::kAway);
  const SetupState after = answered(state, "", {pictures_at(Ask::kAway)[0], {}});
  EXPECT_EQ(after.ask, Ask::kAway);
  EXPECT_NE(after.remark.find("the scanner at serial:/dev/ttyACM1 sends no scans"), std::string::npos);
}

TEST(SetupDialogue, WhoIsNotSeenIsAskedAgain) {
  SetupState state = until(begin_setup(two_scanners(), kFile, std::nullopt), Ask::kAhead);
  state = answered(std::move(state), "", pictures_at(Ask::kAway));
  EXPECT_EQ(state.ask, Ask::kAhead);
  EXPECT_NE(state.remark.find("Nobody is seen there"), std::string::npos);
  EXPECT_EQ(with_defaults(std::move(state)).end, SetupEnd::kAgreed);
}

TEST(SetupDialogue, NoIsNo) {
  const SetupState state = until(begin_setup(two_scanners(), kFile, std::nullopt), Ask::kWrite);
  EXPECT_EQ(answer(state, "n").end, SetupEnd::kRefused);
  EXPECT_EQ(answer(state, "q").end, SetupEnd::kRefused);
}

RC_GTEST_PROP(SetupDialogue, EndsWithinTwelveAnswersWhateverIsSaid, ()) {
  const std::vector<std::string> words{"",    "",     "",      "n", "y", "q", "1", "0.1 0 0.3", "0.3 0.3 0.5",
                                       "zzz", "name", "\x1b[A"};
  SetupState state = begin_setup(two_scanners(), kFile, std::nullopt);
  int asked = 0;
  while (!state.end) {
    RC_ASSERT(!question(state).text.empty());
    RC_ASSERT(!question(state).otherwise.empty());
    const Ask ask = *rc::gen::weightedElement<bool>({{3, true}, {1, false}}) ? state.ask : Ask::kAway;
    state = answered(std::move(state), *rc::gen::elementOf(words), pictures_at(ask));
    RC_ASSERT(++asked <= kSetupAnswersMax);
  }
  if (state.end == SetupEnd::kAgreed)
    RC_ASSERT(faults_text(parse_configuration(configuration_text(state.text, state.values), kFile)) == "");
  else
    RC_ASSERT(!state.remark.empty());
}

}  // namespace
}  // namespace topo::daemon
