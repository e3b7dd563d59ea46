// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/view/request_check.hpp"

#include <gtest/gtest.h>

namespace topo::daemon {
namespace {

const std::vector<std::string> kNames{"robot1", "Robot1.example.org"};

TEST(IsOwnHost, AddressesLocalhostAndOwnNames) {
  for (const char* host : {"127.0.0.1", "127.0.0.1:8080", "192.168.0.7:8080", "[::1]:8080", "[fe80::1]",
                           "localhost", "LOCALHOST:80", "robot1:8080", "robot1.EXAMPLE.org"})
    EXPECT_TRUE(is_own_host(host, kNames)) << host;
}

TEST(IsOwnHost, NoNameThatAnotherSiteMayHave) {
  for (const char* host :
       {"", "evil.example", "evil.example:8080", "robot1.evil.example", "localhost.evil.example",
        "127.0.0.1.evil.example", "127.0.0.1:x", "127.0.0.1:", "127.0.0.1:123456", "[::1", "[::1]x",
        "[robot1]", "robot1@evil.example", "1.2.3", "::1", "robot1 "})
    EXPECT_FALSE(is_own_host(host, kNames)) << host;
  EXPECT_FALSE(is_own_host(std::string(300, 'a'), {std::string(300, 'a')}));
}

TEST(IsOwnOrigin, WhatWasLoadedFromHereOrNoBrowserAtAll) {
  for (const char* origin : {"", "http://robot1:8080", "https://robot1:8080", "http://ROBOT1:8080"})
    EXPECT_TRUE(is_own_origin(origin, "robot1:8080")) << origin;
}

TEST(IsOwnOrigin, NoOtherSite) {
  for (const char* origin :
       {"null", "http://evil.example", "http://robot1", "http://robot1:80", "file://robot1:8080",
        "http://robot1:8080.evil.example", "http://robot1:8080/", "robot1:8080"})
    EXPECT_FALSE(is_own_origin(origin, "robot1:8080")) << origin;
}

}  // namespace
}  // namespace topo::daemon
