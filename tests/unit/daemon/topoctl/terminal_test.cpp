// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/topoctl/terminal.hpp"

#include <gtest/gtest.h>

namespace topo::daemon {
namespace {

TEST(Terminal, LettersAndArrows) {
  EXPECT_EQ(last_key("w"), Key::kForward);
  EXPECT_EQ(last_key("S"), Key::kBack);
  EXPECT_EQ(last_key("a"), Key::kLeft);
  EXPECT_EQ(last_key("d"), Key::kRight);
  EXPECT_EQ(last_key(" "), Key::kStop);
  EXPECT_EQ(last_key("\x1b[A"), Key::kForward);
  EXPECT_EQ(last_key("\x1bOB"), Key::kBack);
  EXPECT_EQ(last_key("\x1b[C"), Key::kRight);
  EXPECT_EQ(last_key("\x1b[D"), Key::kLeft);
  EXPECT_EQ(last_key("x"), Key::kOther);
  EXPECT_EQ(last_key("\x1b"), Key::kOther);
  EXPECT_EQ(last_key(""), std::nullopt);
}

TEST(Terminal, TheLastKeyCountsAndQuitAlways) {
  EXPECT_EQ(last_key("ww "), Key::kStop);
  EXPECT_EQ(last_key("w\x1b[D"), Key::kLeft);
  EXPECT_EQ(last_key("qwww"), Key::kQuit);
  EXPECT_EQ(last_key("\x03"), Key::kQuit);
}

TEST(Terminal, OnlyDirectionsMove) {
  for (const Key key : {Key::kStop, Key::kQuit, Key::kOther})
    EXPECT_EQ(twist_of(key, 0.7, 1.4), types::Twist2{});
  EXPECT_GT(twist_of(Key::kForward, 0.7, 1.4).v_mps, 0.0);
  EXPECT_LT(twist_of(Key::kBack, 0.7, 1.4).v_mps, 0.0);
  EXPECT_GE(twist_of(Key::kBack, 0.7, 1.4).v_mps, -0.1);
  EXPECT_GT(twist_of(Key::kLeft, 0.7, 1.4).omega_radps, 0.0);
  EXPECT_LT(twist_of(Key::kRight, 0.7, 1.4).omega_radps, 0.0);
}

}  // namespace
}  // namespace topo::daemon
