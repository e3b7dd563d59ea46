// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/threads/thread.hpp"

#include <gtest/gtest.h>
#include <pthread.h>

#include <array>
#include <atomic>
#include <string>

#include "daemon/threads/wakeup.hpp"

namespace topo::daemon {
namespace {

TEST(Thread, RunsItsBodyUnderItsName) {
  std::string name;
  {
    Thread thread;
    ThreadSettings settings;
    settings.name = "a-name-too-long-for-the-kernel";
    ASSERT_TRUE(thread.start(settings, [&name, settings] {
      EXPECT_TRUE(apply_settings(settings).empty());
      std::array<char, 32> text{};
      ::pthread_getname_np(::pthread_self(), text.data(), text.size());
      name = text.data();
    }));
  }
  EXPECT_EQ(name, "a-name-too-long");
}

TEST(Thread, WhatIsRefusedIsSaidAndTheRestIsDone) {
  std::vector<std::string> refusals;
  {
    ThreadSettings settings;
    settings.name = "cpus";
    settings.cpus = {1023};  // no machine of ours has it
    Thread thread;           // last: it joins first
    ASSERT_TRUE(thread.start(settings, [&] { refusals = apply_settings(settings); }));
  }
  ASSERT_EQ(refusals.size(), 1U);
  EXPECT_NE(refusals[0].find("thread cpus: not on CPUs 1023"), std::string::npos) << refusals[0];
}

TEST(Thread, RealTimePriorityOrTheReasonWhyNot) {
  const auto tried = try_fifo(40);
  std::vector<std::string> refusals;
  int policy = -1;
  {
    ThreadSettings settings;
    settings.name = "fifo";
    settings.fifo_priority = 40;
    Thread thread;  // last: it joins first
    ASSERT_TRUE(thread.start(settings, [&] {
      refusals = apply_settings(settings);
      sched_param param{};
      ::pthread_getschedparam(::pthread_self(), &policy, &param);
    }));
  }
  EXPECT_EQ(tried.has_value(), refusals.empty());
  EXPECT_EQ(policy == SCHED_FIFO, refusals.empty());
  if (!tried) {
    EXPECT_EQ(tried.error().code, types::Errc::kPermission);
    EXPECT_NE(refusals[0].find("SCHED_FIFO 40"), std::string::npos);
  }
}

TEST(Wakeup, WakesAnotherThreadAndForgetsNothing) {
  Wakeup ping, pong;
  std::atomic<int> heard{0};
  {
    Thread thread;
    ASSERT_TRUE(thread.start({}, [&] {
      while (heard < 1000) {
        if (!ping.wait(std::chrono::seconds(30))) break;
        ++heard;
        pong.post();
      }
    }));
    for (int i = 0; i < 1000; ++i) {
      ping.post();
      ASSERT_TRUE(pong.wait(std::chrono::seconds(30)));
    }
  }
  EXPECT_EQ(heard, 1000);
  EXPECT_FALSE(pong.wait(types::Duration::zero()));
}

}  // namespace
}  // namespace topo::daemon
