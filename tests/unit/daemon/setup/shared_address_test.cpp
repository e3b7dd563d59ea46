// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/setup/shared_address.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace topo::daemon {
namespace {

using Neighbours = std::vector<io::Neighbour>;

TEST(SharedAddress, TwoDevicesAreNamed) {
  const Neighbours heard{{"192.168.0.10", "00:1d:48:00:00:01", "eth0"},
                         {"192.168.0.11", "00:1d:48:00:00:03", "eth0"},
                         {"192.168.0.10", "00:1d:48:00:00:02", "eth1"}};
  const std::string said = shared_address("192.168.0.10", heard);
  EXPECT_NE(
      said.find("2 devices answer at 192.168.0.10: 00:1d:48:00:00:01 on eth0, 00:1d:48:00:00:02 on eth1"),
      std::string::npos)
      << said;
  EXPECT_NE(said.find("laser set-ip 192.168.0.10 NEW"), std::string::npos);
}

TEST(SharedAddress, OneThatIsHeardTwiceIsOne) {
  const Neighbours heard{{"192.168.0.10", "00:1d:48:00:00:01", "eth0"},
                         {"192.168.0.10", "00:1d:48:00:00:01", "wlan0"}};
  EXPECT_EQ(shared_address("192.168.0.10", heard), "");
  EXPECT_EQ(shared_address("192.168.0.10", {}), "");
}

}  // namespace
}  // namespace topo::daemon
