// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/hokuyo/identity.hpp"

#include <gmock/gmock.h>

#include <string>

#include "tests/unit/drivers/hokuyo/scip_text.hpp"
#include "tests/unit/drivers/hokuyo/sensor_samples.hpp"

namespace topo::hokuyo {
namespace {

using testing::HasSubstr;
using namespace testing_scip;

Reply make_reply(const std::string& echo, const std::string& lines) {
  ScipParser parser;
  const std::string text = reply_text(echo, "00", lines);
  const auto progress = parser.feed(std::as_bytes(std::span(text)));
  EXPECT_EQ(progress.event, ScipParser::Event::kReply);
  return parser.reply();
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

std::string key(const std::string& text) {  // "KEY:value" with its check, sum before the semicolon
  std::string summed = with_sum(text);
  return text + ";" + summed[summed.size() - 2] + "\n";
}

TEST(Identity, ReadsEverySampleOfTheFactSheet) {
  for (const Sample& sample : kSamples) {
    SensorInfo info;
    const auto version = read_version(make_reply("VV", sample.vv), info);
    ASSERT_TRUE(version) << version.error().message;
    EXPECT_EQ(info.serial_number, sample.serial);
    EXPECT_EQ(family_of(info.product), sample.family) << info.product;
    const auto parameters = read_parameters(make_reply("PP", sample.pp), info);
    ASSERT_TRUE(parameters) << parameters.error().message;
    EXPECT_EQ(info.step_min, sample.amin);
    EXPECT_EQ(info.step_max, sample.amax);
    EXPECT_EQ(info.distance_max_mm, sample.dmax);
    read_state(make_reply("II", sample.ii), info);
    EXPECT_FALSE(info.status.empty());
  }
}

TEST(Identity, IgnoresOrderAndUnknownKeys) {
  SensorInfo info;
  const Reply reply =
      make_reply("VV", key("ZZZZ:what") + key("SERI:01234567") + "rubbish\n" + key("PROD:UST-10LX"));
  ASSERT_TRUE(read_version(reply, info));
  EXPECT_EQ(info.serial_number, "H1234567");  // a leading 0 is an H
  EXPECT_EQ(info.product, "UST-10LX");
}

TEST(Identity, WrongChecksumOnTheSerialNumberIsForgivenToUrgOnly) {
  SensorInfo info;
  const std::string urg = key("PROD:SOKUIKI Sensor URG-04LX") + "SERI:H0614967;0\n";
  EXPECT_TRUE(read_version(make_reply("VV", urg), info));
  const std::string utm = key("PROD:UTM-30LX-EW") + "SERI:H0614967;0\n";
  const auto refused = read_version(make_reply("VV", utm), info);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, HasSubstr("SERI"));
}

TEST(Identity, AnyPrintedSerialNumberIsTaken) {
  for (const char* serial : {"7", "H12", "0902", "A-12.3_b", "H123456789012345"}) {
    SensorInfo info;
    EXPECT_TRUE(
        read_version(make_reply("VV", key("PROD:UAM-05LP") + key(std::string("SERI:") + serial)), info))
        << serial;
  }
  for (const char* serial : {"", "H1 2", "H1234567890123456"}) {
    SensorInfo info;
    const auto read =
        read_version(make_reply("VV", key("PROD:UAM-05LP") + key(std::string("SERI:") + serial)), info);
    ASSERT_FALSE(read) << serial;
    EXPECT_EQ(read.error().code, types::Errc::kUnsupported);
  }
}

TEST(Identity, AModelThatIsNotListedIsNamed) {
  for (const char* product : {"UTM-30LX-EW", "SOKUIKI Sensor TOP-URG UTM-30LX", "UST-10LX", "UST-20LX",
                              "SOKUIKI Sensor URG-04LX", "SOKUIKI Sensor URG-04LX-UG01"})
    EXPECT_TRUE(is_listed(product)) << product;
  for (const char* product : {"UST-30LX", "UTX-05LX", "UAM-05LP-T301", "UST-10LXFA", "UTM-30LX-FEW", ""})
    EXPECT_FALSE(is_listed(product)) << product;
  SensorInfo info;
  info.product = "UST-30LX";
  info.step_max = 2160;
  EXPECT_EQ(assumption(info),
            "the model \"UST-30LX\" is not known: its codes are those of its family, 2161 steps come 2 by 2");
  info.product = "UAM-05LP";
  info.step_max = 1080;
  EXPECT_EQ(assumption(info), "the model \"UAM-05LP\" is not known: below 20 mm it measured nothing");
  info.product = "UST-10LX";
  EXPECT_EQ(assumption(info), "");
}

TEST(Identity, StepsBeyondAScanAreMerged) {
  SensorInfo info;
  for (const auto& [last, cluster] :
       {std::pair{0, 1}, {1439, 1}, {1440, 2}, {2160, 2}, {2879, 2}, {9999, 7}}) {
    info.step_max = last;
    EXPECT_EQ(cluster_of(info), cluster) << last;
    EXPECT_LE((last + cluster) / cluster, static_cast<int>(types::Scan::kMaxBeams));
  }
}

TEST(Identity, TakesEveryKnownWayToSumALine) {
  SensorInfo info;
  const std::string text = "STAT:fine<-set by user";
  const std::string to_arrow = with_sum("STAT:fine");
  read_state(make_reply("II", text + ";" + to_arrow[to_arrow.size() - 2] + "\n"), info);
  EXPECT_EQ(info.status, "fine<-set by user");
  read_state(make_reply("II", with_sum("STAT:semicolon included;")), info);
  EXPECT_EQ(info.status, "semicolon included");
  read_state(make_reply("II", "STAT:broken;~\n"), info);
  EXPECT_EQ(info.status, "semicolon included");
}

TEST(Identity, RefusesParametersThatWouldHarm) {
  const std::string pp = kSamples[0].pp;
  for (const auto& [from, to] : {std::pair<std::string, std::string>{"AMAX:1080;Z\n", key("AMAX:5000")},
                                 {"AMAX:1080;Z\n", key("AMAX:-1")},
                                 {"AMAX:1080;Z\n", key("AMAX:99999999999999999999")},
                                 {"AMAX:1080;Z\n", ""},
                                 {"AMAX:1080;Z\n", "AMAX:1080;0\n"},
                                 {"ARES:1440;^\n", key("ARES:0")},
                                 {"ARES:1440;^\n", key("ARES:100")},
                                 {"AFRT:540;0\n", key("AFRT:2000")},
                                 {"SCAN:2400;U\n", key("SCAN:0")},
                                 {"DMIN:23;7\n", key("DMIN:-1")},
                                 {"DMIN:23;7\n", key("DMIN:2x")},
                                 {"DMAX:60000;J\n", key("DMAX:20")}}) {
    SensorInfo info;
    const auto read = read_parameters(make_reply("PP", replaced(pp, from, to)), info);
    ASSERT_FALSE(read) << to;
    const bool damaged = to.empty() || to == "AMAX:1080;0\n";
    EXPECT_EQ(read.error().code, damaged ? types::Errc::kProtocol : types::Errc::kUnsupported) << to;
    EXPECT_THAT(read.error().message, HasSubstr(from.substr(0, 4))) << to;
  }
}

TEST(Identity, SerialNumbersCompareAsPeopleMeanThem) {
  EXPECT_TRUE(same_serial("H0902680", "h0902680"));
  EXPECT_TRUE(same_serial("00902680", "H0902680"));
  EXPECT_FALSE(same_serial("H0902680", "H0902681"));
  EXPECT_FALSE(same_serial("H090268", "H0902680"));
}

TEST(Identity, ReadsTheClock) {
  EXPECT_EQ(read_time(make_reply("TM1", "ooool\n")), 16777215U);
  EXPECT_FALSE(read_time(make_reply("TM1", "ooook\n")));
  EXPECT_FALSE(read_time(make_reply("TM1", "")));
}

TEST(Identity, EveryStatusHasWords) {
  for (const char* status : {"0L", "10", "21", "49", "50", "97", "98", "0E", "04", "0I", "E", "zz"}) {
    EXPECT_FALSE(describe_status(status).empty());
  }
  EXPECT_THAT(std::string(describe_status("55")), HasSubstr("hardware"));
}

}  // namespace
}  // namespace topo::hokuyo
