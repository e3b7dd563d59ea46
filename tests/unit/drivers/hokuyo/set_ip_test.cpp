// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/hokuyo/set_ip.hpp"

#include <gmock/gmock.h>

#include "drivers/hokuyo/scip_codec.hpp"
#include "tests/mocks/scripted_stream.hpp"
#include "tests/unit/drivers/hokuyo/sensor_samples.hpp"

namespace topo::hokuyo {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

/// A sensor that answers QT, VV and $IP, and no more.
struct SetIp : testing::Test {
  SetIp() {
    line.on_write = [this](std::string_view bytes) {
      std::string text(bytes.substr(0, bytes.find('\n')));
      heard.push_back(text);
      if (mute) return;
      std::string status = "00", lines;
      if (text == "VV") lines = sample.vv;
      if (text.starts_with("$IP")) status = text.size() == accepted_size ? "00" : refusal;
      line.send(text + "\n" + status + checksum(status) + "\n" + lines + "\n");
    };
  }
  mocks::ScriptedLine line;
  mocks::ScriptedConnector connector{line};
  testing_scip::Sample sample = testing_scip::kSamples[2];  // UST-10LX
  std::vector<std::string> heard;
  std::size_t accepted_size = 39;  ///< of $IP and its parameters
  std::string refusal = "0C";
  bool mute = false;
  IpSettings settings{{192, 168, 0, 11}, {255, 255, 255, 0}, {192, 168, 0, 1}};
};

TEST_F(SetIp, TellsTheScannerItsAddress) {
  const auto taken = set_ip(connector, settings);
  ASSERT_TRUE(taken) << taken.error().message;
  EXPECT_EQ(taken->serial_number, "H1614934");
  EXPECT_EQ(heard.back(), "$IP192168000011255255255000192168000001");
}

TEST_F(SetIp, AFirmwareThatWantsDotsGetsThem) {
  accepted_size = 48;
  ASSERT_TRUE(set_ip(connector, settings));
  EXPECT_EQ(heard.back(), "$IP192.168.000.011255.255.255.000192.168.000.001");
}

TEST_F(SetIp, AModelWithoutAnAddressIsRefusedAndNotTried) {
  for (const std::size_t model : {1U, 3U}) {  // UTM-30LX and URG-04LX, both on USB
    sample = testing_scip::kSamples[model];
    heard.clear();
    const auto refused = set_ip(connector, settings);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, types::Errc::kUnsupported);
    EXPECT_THAT(refused.error().message,
                HasSubstr("has no network address that can be set; expected a UTM-30LX-EW"));
    EXPECT_THAT(heard, testing::Not(testing::Contains(testing::StartsWith("$"))));
  }
}

TEST_F(SetIp, AFirmwareThatRefusesIsNamed) {
  accepted_size = 0;
  refusal = "0E";
  const auto refused = set_ip(connector, settings);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message,
              HasSubstr("UST-10LX H1614934 (firmware 4.0.2-A) refuses $IP with status 0E"));
}

TEST_F(SetIp, AnotherScannerIsNotTouched) {
  const auto refused = set_ip(connector, settings, "H0000001");
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, HasSubstr("found UST-10LX H1614934, expected H0000001"));
  EXPECT_EQ(heard.back(), "VV");
}

TEST_F(SetIp, AScannerInUseDoesNotAnswer) {
  mute = true;
  const auto refused = set_ip(connector, settings);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, HasSubstr("no other program, topometricd among them"));
}

TEST_F(SetIp, IsConfirmedByTheSerialNumberAtTheNewAddress) {
  EXPECT_TRUE(await_sensor(connector, "H1614934", 10s));
  const auto other = await_sensor(connector, "H0000001", 10s);
  ASSERT_FALSE(other);
  EXPECT_EQ(other.error().code, types::Errc::kInvalidInput);
  line.refuse = true;
  const types::Stamp begun = line.now;
  const auto nobody = await_sensor(connector, "H1614934", 10s);
  ASSERT_FALSE(nobody);
  EXPECT_EQ(nobody.error().code, types::Errc::kTimeout);
  EXPECT_THAT(nobody.error().message, HasSubstr("was its power switched off and on"));
  EXPECT_LT(line.now - begun, 12s);
}

TEST(IpSettings, OnlyAHostsAddressIsTaken) {
  for (const char* bad : {"", "1.2.3", "1.2.3.4.5", "256.1.1.1", "a.b.c.d", "1.2.3.-4", "1..2.3", "1.2.3.4 "})
    EXPECT_FALSE(parse_ipv4(bad)) << bad;
  ASSERT_TRUE(parse_ipv4("10.0.0.255"));
  EXPECT_EQ(to_text(*parse_ipv4("192.168.0.11")), "192.168.0.11");
  const IpSettings good{{192, 168, 0, 11}, {255, 255, 255, 0}, {192, 168, 0, 1}};
  EXPECT_TRUE(check(good));
  for (const IpSettings& bad : {IpSettings{{192, 168, 0, 0}, good.netmask, good.gateway},
                                IpSettings{{192, 168, 0, 255}, good.netmask, good.gateway},
                                IpSettings{{127, 0, 0, 2}, good.netmask, {127, 0, 0, 1}},
                                IpSettings{{224, 0, 0, 2}, good.netmask, {224, 0, 0, 1}},
                                IpSettings{good.address, {255, 0, 255, 0}, good.gateway},
                                IpSettings{good.address, {0, 0, 0, 0}, good.gateway},
                                IpSettings{good.address, good.netmask, {192, 168, 1, 1}},
                                IpSettings{good.address, good.netmask, good.address}}) {
    const auto refused = check(bad);
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message, HasSubstr("expected"));
  }
}

}  // namespace
}  // namespace topo::hokuyo
