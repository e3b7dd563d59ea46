// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// How `topoctl setup` looks for bases on CAN, with a listing of interfaces. Buses of the kernel:
// can_wire_test.cpp.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "daemon/setup/device_search.hpp"
#include "tests/unit/daemon/support/temp_dir.hpp"

namespace topo::test {
namespace {

using testing::HasSubstr;

constexpr types::Duration kLimit = std::chrono::seconds(60);

/// A folder as /sys/class/net, with one CAN interface and one that is none.
struct Listing {
  daemon::testing::TempDir folder;
  Listing() {
    for (const auto& [name, type] : {std::pair{"eth0", "1"}, std::pair{"can0", "280"}}) {
      std::filesystem::create_directory(folder.file(name));
      std::ofstream(folder.file(std::string(name) + "/type")) << type << "\n";
    }
  }
  [[nodiscard]] daemon::SearchPlaces places() const {
    daemon::SearchPlaces out;
    out.serial = out.tcp = {};
    out.network_interfaces = folder.str();
    return out;
  }
};

bool never() { return false; }

/// The interface of the listing is none of this machine: the daemon's own connector says so, once.
TEST(CanSearch, AnInterfaceThatIsNotThereIsToldOnce) {
  const Listing listing;
  std::filesystem::rename(listing.folder.file("can0"), listing.folder.file("nocan7"));
  const auto found = daemon::search_devices(listing.places(), kLimit, never).found;
  EXPECT_TRUE(found.bases.empty());
  ASSERT_EQ(found.notes.size(), 1U) << testing::PrintToString(found.notes);
  EXPECT_THAT(found.notes[0], HasSubstr("can:nocan7:0, can:nocan7:1"));
  EXPECT_THAT(found.notes[0], HasSubstr("no interface nocan7"));
}

}  // namespace
}  // namespace topo::test
