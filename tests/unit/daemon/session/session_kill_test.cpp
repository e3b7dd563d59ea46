// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// A process that saves is killed at random instants: there is always a whole session, the old or the new one.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <set>

#include "daemon/session/session_reader.hpp"
#include "daemon/session/session_writer.hpp"
#include "tests/unit/daemon/session/session_sample.hpp"
#include "tests/unit/daemon/support/temp_dir.hpp"

namespace topo::daemon {
namespace {

[[noreturn]] void save_for_ever(const std::string& path, const std::vector<slam::Session>& generations) {
  for (std::size_t i = 0;; ++i) {
    if (!save_session(path, generations[i % generations.size()], i)) ::_exit(1);
  }
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
    const pid_t child = ::fork();
    if (child == 0) save_for_ever(path, generations);
    ::usleep(static_cast<useconds_t>(random() % 12000));
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
  EXPECT_GT(seen.size(), 1U) << "the kills came before anything was saved";
}

}  // namespace
}  // namespace topo::daemon
