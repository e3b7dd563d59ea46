// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/io/run_program.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <iostream>
#include <string>

namespace topo::io {
namespace {

int says_nothing(int, char**) { return 0; }
int prints_a_word(int, char**) {
  fmt::print("word\n");
  return 0;
}
int prints_more_than_a_buffer(int, char**) {
  fmt::print("{}\n", std::string(100'000, 'x'));
  return 0;
}
int streams_a_line(int, char**) {
  std::cout << "line" << std::endl;
  return 0;
}
int fails_with_three(int, char**) {
  fmt::print("word\n");
  return 3;
}
int gives_the_next_descriptor(int, char**) { return ::open("/dev/null", O_RDWR); }

using Start = int (*)(int, char**);

[[noreturn]] void run_on(const char* path, Start start) {
  if (std::freopen(path, "w", stdout) == nullptr) ::_exit(99);
  ::_exit(run_program("program", start, 0, nullptr));
}

[[noreturn]] void run_with_closed_output(Start start) {
  ::close(STDOUT_FILENO);
  ::_exit(run_program("program", start, 0, nullptr));
}

TEST(RunProgramDeathTest, GivesTheProgramsStatus) {
  EXPECT_EXIT(run_on("/dev/null", prints_a_word), ::testing::ExitedWithCode(0), "^$");
  EXPECT_EXIT(run_on("/dev/null", fails_with_three), ::testing::ExitedWithCode(3), "^$");
}

TEST(RunProgramDeathTest, FailsWhenTheOutputIsFull) {
  const char* said = "program: standard output: cannot be written";
  EXPECT_EXIT(run_on("/dev/full", prints_a_word), ::testing::ExitedWithCode(1), "No space left");
  EXPECT_EXIT(run_on("/dev/full", prints_more_than_a_buffer), ::testing::ExitedWithCode(1), said);
  EXPECT_EXIT(run_on("/dev/full", streams_a_line), ::testing::ExitedWithCode(1), said);
  EXPECT_EXIT(run_on("/dev/full", fails_with_three), ::testing::ExitedWithCode(3), said);
  EXPECT_EXIT(run_on("/dev/full", says_nothing), ::testing::ExitedWithCode(0), "^$");
}

TEST(RunProgramDeathTest, FailsWhenTheOutputIsClosedAndIsWrittenTo) {
  EXPECT_EXIT(run_with_closed_output(prints_a_word), ::testing::ExitedWithCode(1), "Bad file descriptor");
  EXPECT_EXIT(run_with_closed_output(says_nothing), ::testing::ExitedWithCode(0), "^$");
}

TEST(RunProgramDeathTest, NoFileTakesAClosedOutputsNumber) {
  EXPECT_EXIT(
      run_with_closed_output(gives_the_next_descriptor),
      [](int status) { return WIFEXITED(status) && WEXITSTATUS(status) > STDERR_FILENO; }, "^$");
}

}  // namespace
}  // namespace topo::io
