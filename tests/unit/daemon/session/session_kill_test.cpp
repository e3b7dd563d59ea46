// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// A process that saves is killed at random instants: there is always a whole session, the old or the new one.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <set>

#include "daemon/session/session_reader.hpp"
#include "daemon/session/session_writer.hpp"
#include "tests/unit/daemon/session/session_sample.hpp"
#include "tests/unit/daemon/support/temp_dir.hpp"

namespace topo::daemon {
namespace {

/// Tells through the pipe when the first one is saved.
[[noreturn]] void save_for_ever(const std::string& path, const std::vector<slam::Session>& generations,
                                int pipe_fd) {
  for (std::size_t i = 1;; ++i) {
    if (!save_session(path, generations[i % generations.size()], i)) ::_exit(1);
    if (i == 1 && ::write(pipe_fd, "1", 1) != 1) ::_exit(1);
  }
}

/// Microseconds until there is something to read.
std::int64_t wait_us(int pipe_fd) {
  const auto begin = std::chrono::steady_clock::now();
  char byte{};
  EXPECT_EQ(::read(pipe_fd, &byte, 1), 1) << "the child failed to save";
  return std::chrono::duration_cast<std::chrono::microseconds>(std::chrono::steady_clock::now() - begin)
      .count();
}

TEST(SessionKill, TheOldFileSurvivesAKillAtAnyInstant) {
  const testing::TempDir folder;
  const std::string path = folder.file("office.session");
  std::vector<slam::Session> generations;
  for (unsigned i = 0; i < 4; ++i) generations.push_back(testing::sample_session(20 + 10 * i, i));
  ASSERT_TRUE(save_session(path, generations[0], 0));
  std::mt19937 random(6);
  std::set<std::size_t> seen;
  constexpr int kKills = 60;
  for (int i = 0; i < kKills; ++i) {
    std::array<int, 2> saved{};
    ASSERT_EQ(::pipe2(saved.data(), O_CLOEXEC), 0);
    const pid_t child = ::fork();
    if (child == 0) save_for_ever(path, generations, saved[1]);
    ::close(saved[1]);
    // A random instant of the next few savings, as long as they take on this machine.
    const std::int64_t one_us = wait_us(saved[0]);
    ::usleep(static_cast<useconds_t>(random() % static_cast<std::uint64_t>(3 * one_us + 1)));
    ::close(saved[0]);
    ASSERT_EQ(::kill(child, SIGKILL), 0);
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status)) << "the child failed to save";
    const auto loaded = load_session(path);
    ASSERT_TRUE(loaded) << loaded.error().message;
    ASSERT_TRUE(loaded->closed) << "kill " << i;
    const std::size_t generation = loaded->params_hash % generations.size();
    ASSERT_TRUE(testing::same(loaded->session, generations[generation])) << "kill " << i;
    seen.insert(generation);
  }
  EXPECT_GT(seen.size(), 1U) << "every kill came at the same place";
}

}  // namespace
}  // namespace topo::daemon
