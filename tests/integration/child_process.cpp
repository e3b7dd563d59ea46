// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/integration/child_process.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "drivers/io/posix.hpp"

namespace topo::test {
namespace {

/// In the child: only what is safe between fork(2) and execve(2) of a process with threads.
[[noreturn]] void become(const char* path, char* const* words, const char* log, const char* members) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  sigset_t none;
  sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  const int out = ::open(log, O_WRONLY | O_CREAT | O_APPEND, 0644);
  ::dup2(out, STDOUT_FILENO);
  ::dup2(out, STDERR_FILENO);
  if (members[0] != '\0') {
    const int group = ::open(members, O_WRONLY);
    if (::write(group, "0", 1) != 1) ::_exit(126);
  }
  ::execv(path, words);
  ::_exit(127);
}

}  // namespace

std::unique_ptr<ChildProcess> ChildProcess::start(const std::string& program,
                                                  const std::vector<std::string>& arguments,
                                                  const std::string& log, const std::string& cgroup) {
  const std::string path = std::string(TOPOMETRIC_PROGRAMS) + "/" + program;
  if (::access(path.c_str(), X_OK) != 0) return ADD_FAILURE() << path << " cannot be run", nullptr;
  std::vector<std::string> texts{path};
  texts.insert(texts.end(), arguments.begin(), arguments.end());
  std::vector<char*> words;
  for (std::string& text : texts) words.push_back(text.data());
  words.push_back(nullptr);
  const std::string members = cgroup.empty() ? "" : cgroup + "/cgroup.procs";
  const pid_t pid = ::fork();
  if (pid == 0) become(path.c_str(), words.data(), log.c_str(), members.c_str());
  if (pid < 0) return ADD_FAILURE() << "fork failed", nullptr;
  return std::unique_ptr<ChildProcess>(new ChildProcess(pid));
}

ChildProcess::~ChildProcess() {
  if (pid_ == 0) return;
  signal(SIGKILL);
  wait();
}

void ChildProcess::signal(int number) const { EXPECT_EQ(::kill(pid_, number), 0); }

int ChildProcess::wait() {
  int status = 0;
  EXPECT_EQ(io::retry_interrupted([&] { return ::waitpid(pid_, &status, 0); }), pid_);
  pid_ = 0;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace topo::test
