// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// Operators press and clear while the base reads and latches: the newest act always holds.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
#include <thread>

#include "core/motion/velocity_gate.hpp"
#include "core/sync/estop_line.hpp"
#include "tests/stress/yielding.hpp"

namespace topo::sync {
namespace {

/// Each act is written down when it is done, and the base writes down what it read before the act and after
/// it.
template <class Steps>
void check_estop(int rounds) {
  EStopLine<Steps> line;
  std::atomic<int> asked{0}, answered{0};
  std::atomic<bool> latched{false};
  std::thread base([&] {
    motion::GateState state;
    while (true) {
      const int before = asked.load();
      const auto reading = line.read();
      motion::GateInput input;
      input.estop_pressed = reading.pressed;
      input.estop_cleared = reading.cleared;
      motion::update_latch(state, input);
      latched.store(state.estop_latched);
      answered.store(before);  // a whole period lies behind this question
      if (before == rounds) return;
      std::this_thread::yield();
    }
  });
  std::uint64_t wrong = 0;
  std::uint64_t dice = 5;
  for (int round = 1; round <= rounds; ++round) {
    bool pressed = false;
    dice = dice * 6364136223846793005U + 1442695040888963407U;
    for (std::uint64_t acts = 1 + (dice >> 33U) % 4; acts > 0; --acts) {
      pressed = ((dice >> (40U + acts)) & 1U) != 0;
      pressed ? line.press() : line.clear();
    }
    asked.store(round);
    while (answered.load() < round) std::this_thread::yield();
    if (latched.load() != pressed) ++wrong;
  }
  base.join();
  EXPECT_EQ(wrong, 0U);
}

TEST(EStopStress, TheNewestActHolds) { check_estop<Undisturbed>(20000); }
TEST(EStopStressYielding, TheNewestActHolds) { check_estop<stress::Yielding>(5000); }

}  // namespace
}  // namespace topo::sync
