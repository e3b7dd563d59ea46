// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/integration/process_faults.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <ctime>
#include <filesystem>
#include <fstream>

namespace topo::test {
namespace {

std::atomic<bool> hanging{false};

extern "C" void hold_this_thread(int) {
  const int error = errno;
  constexpr long kNap_ns = 1'000'000;
  const timespec nap{0, kNap_ns};
  while (hanging.load()) ::nanosleep(&nap, nullptr);
  errno = error;
}

const std::vector<std::string>& daemon_threads() {
  static const std::vector<std::string> kNames{"base",    "front",    "coronal", "mapping",
                                               "closure", "planning", "journal", "daemon-main"};
  return kNames;
}

std::string first_line_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  return line;
}

}  // namespace

std::size_t HungThreads::hang(const std::vector<std::string>& names) {
  const std::vector<std::string>& wanted = names.empty() ? daemon_threads() : names;
  struct sigaction action {};
  action.sa_handler = hold_this_thread;
  action.sa_flags = SA_RESTART;
  ::sigaction(SIGUSR2, &action, nullptr);
  hanging = true;
  std::size_t struck = 0;
  for (const auto& task : std::filesystem::directory_iterator("/proc/self/task")) {
    const std::string name = first_line_of(task.path() / "comm");
    if (std::find(wanted.begin(), wanted.end(), name) == wanted.end()) continue;
    const auto thread = static_cast<pid_t>(std::stol(task.path().filename()));
    struck += ::syscall(SYS_tgkill, ::getpid(), thread, SIGUSR2) == 0 ? 1U : 0U;
  }
  return struck;
}

void HungThreads::release() { hanging = false; }

CpuHog::CpuHog(unsigned threads) {
  for (unsigned i = 0; i < threads; ++i)
    threads_.emplace_back([this] {
      while (!stop_.load(std::memory_order_relaxed)) {
      }
    });
}

CpuHog::~CpuHog() {
  stop_ = true;
  for (std::thread& thread : threads_) thread.join();
}

void set_disk_full(bool full) {
  rlimit limit{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &limit), 0);
  limit.rlim_cur = full ? 0 : limit.rlim_max;
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &limit), 0);
}

}  // namespace topo::test
