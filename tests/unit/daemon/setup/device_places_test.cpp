// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/setup/device_places.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/unit/daemon/support/temp_dir.hpp"

namespace topo::daemon {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;

SearchPlaces nowhere() {
  SearchPlaces places;
  places.serial = places.tcp = {};
  places.network_interfaces.clear();
  return places;
}

TEST(DevicePlaces, ADeviceWithTwoNamesIsLookedAtOnceByTheFirst) {
  const testing::TempDir folder;
  std::ofstream(folder.file("ttyUSB0")).put('x');
  std::ofstream(folder.file("ttyUSB1")).put('x');
  fs::create_symlink(folder.file("ttyUSB1"), folder.file("base-usb-1"));
  SearchPlaces places = nowhere();
  places.serial = {folder.file("base-*"), folder.file("ttyUSB*"), folder.file("none*")};
  EXPECT_THAT(addresses_of(places), ElementsAre(SearchPlace{"serial:" + folder.file("base-usb-1"), false},
                                                SearchPlace{"serial:" + folder.file("ttyUSB0"), false}));
}

TEST(DevicePlaces, AHostIsAtTheScannersPort) {
  SearchPlaces places = nowhere();
  places.tcp = {"192.168.0.10", "127.0.0.1:1234", "tcp:192.168.0.10:10940"};
  places.bases = {"tcp:127.0.0.1:8101"};
  EXPECT_THAT(addresses_of(places),
              ElementsAre(SearchPlace{"tcp:192.168.0.10:10940", false},
                          SearchPlace{"tcp:127.0.0.1:1234", false}, SearchPlace{"tcp:127.0.0.1:8101", true}));
}

TEST(DevicePlaces, OnlyCanInterfacesAreAskedForBases) {
  const testing::TempDir folder;
  for (const auto& [name, type] : {std::pair{"eth0", "1"}, std::pair{"can0", "280"}}) {
    fs::create_directory(folder.file(name));
    std::ofstream(folder.file(std::string(name) + "/type")) << type << "\n";
  }
  SearchPlaces places = nowhere();
  places.network_interfaces = folder.str();
  const auto found = addresses_of(places);
  ASSERT_EQ(found.size(), 8U);
  EXPECT_EQ(found.front(), (SearchPlace{"can:can0:0", true}));
  EXPECT_EQ(found.back(), (SearchPlace{"can:can0:7", true}));
}

}  // namespace
}  // namespace topo::daemon
