// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/link/cyclone_config.hpp"

#include <gmock/gmock.h>

namespace topo::daemon {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

RadioPlan plan() {
  RadioPlan p;
  p.interface = "wlan0";
  p.team = 0x1234;
  return p;
}

TEST(CycloneConfig, MulticastCarriesDiscoveryAndData) {
  EXPECT_THAT(cyclone_config(plan(), "/p"),
              AllOf(HasSubstr("<NetworkInterface name=\"wlan0\"/>"),
                    HasSubstr("<AllowMulticast>spdp,asm</AllowMulticast>"),
                    HasSubstr("<DefaultMulticastAddress>239.192.18.52</DefaultMulticastAddress>"),
                    Not(HasSubstr("Peer")), Not(HasSubstr("Security"))));
}

// Otherwise ending hangs while the interface is down.
TEST(CycloneConfig, OneReceiveThread) {
  EXPECT_THAT(cyclone_config(plan(), "/p"),
              HasSubstr("<MultipleReceiveThreads>false</MultipleReceiveThreads>"));
}

TEST(CycloneConfig, ListedPeersNeedNoMulticast) {
  RadioPlan p = plan();
  p.peers = {"10.0.0.2", "10.0.0.3"};
  EXPECT_THAT(cyclone_config(p, "/p"),
              AllOf(HasSubstr("<AllowMulticast>false</AllowMulticast>"),
                    HasSubstr("<Peers><Peer Address=\"10.0.0.2\"/><Peer Address=\"10.0.0.3\"/></Peers>"),
                    HasSubstr("<ParticipantIndex>auto</ParticipantIndex>")));
}

TEST(CycloneConfig, CredentialsAndPluginsAreNamed) {
  RadioPlan p = plan();
  p.security = "/etc/a&b<\"";
  EXPECT_THAT(
      cyclone_config(p, "/p"),
      AllOf(HasSubstr("path=\"/p/libdds_security_auth.so\""), HasSubstr("path=\"/p/libdds_security_ac.so\""),
            HasSubstr("path=\"/p/libdds_security_crypto.so\""),
            HasSubstr("<PrivateKey>file:/etc/a&amp;b&lt;&quot;/identity-key.pem</PrivateKey>"),
            HasSubstr("<Governance>file:")));
}

TEST(CycloneConfig, TeamsHaveGroupsOfTheirOwn) {
  EXPECT_EQ(team_group(0xFFFF'FFFF'FFFF'01FFU), "239.192.1.255");
  EXPECT_NE(team_group(1), team_group(2));
}

}  // namespace
}  // namespace topo::daemon
