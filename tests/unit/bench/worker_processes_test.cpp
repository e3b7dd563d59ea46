// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/table/worker_processes.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <map>

namespace topo::bench {
namespace {

constexpr std::chrono::seconds kLong{600};

using Texts = std::map<std::size_t, types::Result<std::string>>;

Texts texts_of(std::size_t count, int at_once, const Work& work) {
  Texts texts;
  const auto status = run_in_processes(count, {at_once, kLong}, work, [&](std::size_t job, const auto& text) {
    EXPECT_TRUE(texts.emplace(job, text).second) << "told twice";
    return types::Status{};
  });
  EXPECT_TRUE(status.has_value()) << (status ? "" : status.error().message);
  EXPECT_EQ(texts.size(), count);
  return texts;
}

TEST(WorkerProcesses, handOverTextsOfAnySize) {
  const auto work = [](std::size_t job) -> types::Result<std::string> {
    return std::string(job * 100000, static_cast<char>('a' + job));
  };
  for (const int at_once : {1, 3, 50}) {
    for (const auto& [job, text] : texts_of(8, at_once, work)) {
      ASSERT_TRUE(text.has_value()) << text.error().message;
      EXPECT_EQ(*text, *work(job)) << job;
    }
  }
}

TEST(WorkerProcesses, thatDieTakeNothingWithThem) {
  const auto work = [](std::size_t job) -> types::Result<std::string> {
    if (job == 1) ::raise(SIGKILL);
    if (job == 2) ::_exit(7);
    if (job == 3) return types::fail(types::Errc::kInvalidInput, "no such world");
    return "whole";
  };
  const Texts texts = texts_of(5, 2, work);
  EXPECT_EQ(*texts.at(0), "whole");
  ASSERT_FALSE(texts.at(1).has_value());
  EXPECT_NE(texts.at(1).error().message.find("signal 9"), std::string::npos) << texts.at(1).error().message;
  ASSERT_FALSE(texts.at(2).has_value());
  EXPECT_NE(texts.at(2).error().message.find("status 7"), std::string::npos) << texts.at(2).error().message;
  ASSERT_FALSE(texts.at(3).has_value());
  EXPECT_EQ(texts.at(3).error().message, "no such world");
  EXPECT_EQ(*texts.at(4), "whole");
}

TEST(WorkerProcesses, areNoMoreAtOnceThanWasSaid) {
  // A socket of datagrams holds a token for each that may work: who finds none is one too many.
  std::array<int, 2> tokens{};
  ASSERT_EQ(::socketpair(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK, 0, tokens.data()), 0);
  char token = 't';
  for (int i = 0; i < 2; ++i) ASSERT_EQ(::write(tokens[0], &token, 1), 1);
  const auto work = [&](std::size_t) -> types::Result<std::string> {
    char own = 0;
    if (::read(tokens[1], &own, 1) != 1) return types::fail(types::Errc::kBusy, "one too many");
    ::usleep(2000);  // so that others are at work, too
    if (::write(tokens[0], &own, 1) != 1) return types::fail(types::Errc::kIo, "the token is lost");
    return std::string("done");
  };
  for (const auto& [job, text] : texts_of(20, 2, work))
    EXPECT_TRUE(text.has_value()) << job << ": " << text.error().message;
  for (const int fd : tokens) ::close(fd);
}

TEST(WorkerProcesses, endWithTheFirstErrorOfWhoIsTold) {
  int told = 0;
  const auto status = run_in_processes(
      100, {4, kLong},
      [](std::size_t job) -> types::Result<std::string> {
        if (job > 0) ::pause();
        return std::string("first");
      },
      [&](std::size_t, const auto&) {
        ++told;
        return types::Status(types::fail(types::Errc::kIo, "the disk is full"));
      });
  ASSERT_FALSE(status.has_value());
  EXPECT_EQ(status.error().message, "the disk is full");
  EXPECT_EQ(told, 1);
  EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1) << "no child is left";
}

TEST(WorkerProcesses, thatHangAreKilledAndHoldUpNobody) {
  const auto work = [](std::size_t job) -> types::Result<std::string> {
    if (job == 0) ::pause();
    return "whole";
  };
  Texts texts;
  const auto status =
      run_in_processes(6, {2, std::chrono::seconds(2)}, work, [&](std::size_t job, const auto& text) {
        texts.emplace(job, text);
        return types::Status{};
      });
  ASSERT_TRUE(status.has_value());
  ASSERT_EQ(texts.size(), 6U);
  ASSERT_FALSE(texts.at(0).has_value());
  EXPECT_EQ(texts.at(0).error().code, types::Errc::kTimeout);
  EXPECT_NE(texts.at(0).error().message.find("2 s"), std::string::npos) << texts.at(0).error().message;
  for (std::size_t job = 1; job < 6; ++job) EXPECT_EQ(*texts.at(job), "whole");
  EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1) << "no child is left";
}

TEST(WorkerProcesses, dieWithTheirParent) {
  std::array<int, 2> pids{}, alive{};
  ASSERT_EQ(::pipe(pids.data()), 0);
  ASSERT_EQ(::pipe(alive.data()), 0);
  const pid_t parent = ::fork();
  if (parent == 0) {
    ::close(alive[0]);
    (void)run_in_processes(
        1, {1, kLong},
        [&](std::size_t) -> types::Result<std::string> {
          const char byte = 'w';
          if (::write(pids[1], &byte, 1) == 1) ::pause();
          return std::string();
        },
        [](std::size_t, const auto&) { return types::Status{}; });
    ::_exit(0);
  }
  ::close(alive[1]);
  char byte = 0;
  ASSERT_EQ(::read(pids[0], &byte, 1), 1) << "the worker works";
  ASSERT_EQ(::kill(parent, SIGKILL), 0);
  ASSERT_EQ(::waitpid(parent, nullptr, 0), parent);
  EXPECT_EQ(::read(alive[0], &byte, 1), 0) << "its end is open in nobody: the worker is gone";
  for (const int fd : {pids[0], pids[1], alive[0]}) ::close(fd);
}

}  // namespace
}  // namespace topo::bench
