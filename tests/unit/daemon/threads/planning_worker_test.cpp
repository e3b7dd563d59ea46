// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/threads/planning_worker.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <thread>

#include "daemon/logging/event_catalogue.hpp"
#include "drivers/io/posix.hpp"

namespace topo::daemon {
namespace {

using namespace std::chrono_literals;

TEST(PlanningWorker, IsToldToBeSlowOnceNotAtEveryPeriod) {
  const auto hand_overs = std::make_unique<HandOvers>();
  Vitals vitals("planning");
  PlanningWorker worker(*hand_overs, pipeline::PlannerParams{}, 1ns, 1, vitals);
  const types::Stamp begin = io::monotonic_now();
  std::thread thread([&worker] { worker.run(); });
  while (vitals.run.summary().count < 20 && io::monotonic_now() < begin + 60s) std::this_thread::yield();
  hand_overs->ending.stopping = true;
  hand_overs->to_planning.wakeup.post();
  thread.join();
  EXPECT_GE(vitals.run.summary().count, 20U);
  int told = 0;
  for (const auto* event = vitals.events.front(); event != nullptr; event = vitals.events.front(), ++told) {
    EXPECT_NE(format_event(*event).find("1 times since the start"), std::string::npos)
        << format_event(*event);
    vitals.events.pop();
  }
  EXPECT_EQ(told, 1);
}

}  // namespace
}  // namespace topo::daemon
