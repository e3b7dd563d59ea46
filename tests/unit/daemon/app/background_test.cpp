// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/app/background.hpp"

#include <gtest/gtest.h>
#include <poll.h>

#include <atomic>
#include <thread>
#include <vector>

#include "drivers/io/posix.hpp"

namespace topo::daemon {
namespace {

using namespace std::chrono_literals;

template <class Done>
bool collect_until(Background& background, Done done) {
  const types::Stamp limit = io::monotonic_now() + 20s;
  while (!done() && io::wait_for(background.fd(), POLLIN, limit - io::monotonic_now()) > 0)
    background.collect();
  return done();
}

TEST(Background, RunsJobsInOrderThereAndFinishesThemHere) {
  Background background;
  ASSERT_TRUE(background.start("test"));
  const auto here = std::this_thread::get_id();
  std::vector<int> finished;
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(background.add([&finished, here, i]() -> Background::Finish {
      EXPECT_NE(std::this_thread::get_id(), here);
      return [&finished, here, i] {
        EXPECT_EQ(std::this_thread::get_id(), here);
        finished.push_back(i);
      };
    }));
  }
  EXPECT_TRUE(collect_until(background, [&] { return finished.size() == 3; }));
  EXPECT_EQ(finished, (std::vector<int>{0, 1, 2}));
}

TEST(Background, RefusesWhenTooMuchWaitsAndAfterTheEnd) {
  Background background;
  ASSERT_TRUE(background.start("test"));
  std::atomic<bool> go{false};
  int finished = 0;
  const auto job = [&]() -> Background::Finish {
    go.wait(false);
    return [&finished] { ++finished; };
  };
  int taken = 0;
  while (taken < 100 && background.add(job)) ++taken;
  EXPECT_LT(taken, 100);
  go.store(true);
  go.notify_all();
  EXPECT_TRUE(collect_until(background, [&] { return finished == taken; }));
  background.stop();
  EXPECT_FALSE(background.add(job));
}

}  // namespace
}  // namespace topo::daemon
