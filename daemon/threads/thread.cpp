// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/threads/thread.hpp"

#include <fmt/format.h>
#include <limits.h>
#include <malloc.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace topo::daemon {
namespace {

using types::Errc;

// With MCL_ONFAULT only touched pages are locked. g++ 12's headers define it; older kernels do not support
// it.
constexpr int kLockFlags = MCL_CURRENT | MCL_FUTURE | MCL_ONFAULT;

tl::unexpected<types::Error> refused(const std::string& what, int error) {
  const Errc code = error == EPERM || error == ENOMEM ? Errc::kPermission : Errc::kIo;
  return types::fail(code, fmt::format("{}: {}", what, std::strerror(error)), error);
}

int set_fifo(int priority) {
  sched_param param{};
  param.sched_priority = priority;
  return ::pthread_setschedparam(::pthread_self(), SCHED_FIFO, &param);
}

}  // namespace

types::Status Thread::start(const ThreadSettings& settings, std::function<void()> body) {
  body_ = std::move(body);
  pthread_attr_t attributes;
  ::pthread_attr_init(&attributes);
  ::pthread_attr_setstacksize(&attributes,
                              std::max(settings.stack_bytes, static_cast<std::size_t>(PTHREAD_STACK_MIN)));
  const int error = ::pthread_create(&handle_, &attributes, &Thread::enter, this);
  ::pthread_attr_destroy(&attributes);
  if (error != 0) return refused(fmt::format("thread {} cannot be started", settings.name), error);
  running_ = true;
  return {};
}

void* Thread::enter(void* self) {
  static_cast<Thread*>(self)->body_();
  return nullptr;
}

void Thread::join() {
  if (!running_) return;
  ::pthread_join(handle_, nullptr);
  running_ = false;
}

std::vector<std::string> apply_settings(const ThreadSettings& settings) {
  std::vector<std::string> refusals;
  ::pthread_setname_np(::pthread_self(), settings.name.substr(0, 15).c_str());
  if (settings.fifo_priority > 0) {
    if (const int error = set_fifo(settings.fifo_priority); error != 0) {
      refusals.push_back(fmt::format("thread {}: no SCHED_FIFO {}: {} (LimitRTPRIO, or root)", settings.name,
                                     settings.fifo_priority, std::strerror(error)));
    }
  } else if (settings.nice != 0) {
    // On Linux the nice value applies to the thread that sets it.
    errno = 0;
    if (::setpriority(PRIO_PROCESS, 0, settings.nice) != 0) {
      refusals.push_back(
          fmt::format("thread {}: no nice {}: {}", settings.name, settings.nice, std::strerror(errno)));
    }
  }
  if (settings.cpus.empty()) return refusals;
  cpu_set_t set;
  CPU_ZERO(&set);
  for (const int cpu : settings.cpus) {
    if (cpu >= 0 && cpu < CPU_SETSIZE) CPU_SET(static_cast<std::size_t>(cpu), &set);
  }
  if (const int error = ::pthread_setaffinity_np(::pthread_self(), sizeof set, &set); error != 0) {
    refusals.push_back(fmt::format("thread {}: not on CPUs {}: {}", settings.name,
                                   fmt::join(settings.cpus, ", "), std::strerror(error)));
  }
  return refusals;
}

types::Status lock_memory() {
  if (::mlockall(kLockFlags) == 0) return {};
  return refused("memory cannot be locked (LimitMEMLOCK)", errno);
}

void keep_freed_memory() {
  constexpr int kBlock_bytes = 32 << 20;  // the most that glibc takes; larger ones are mapped one by one
  ::mallopt(M_MMAP_THRESHOLD, kBlock_bytes);
  ::mallopt(M_TRIM_THRESHOLD, 2 * kBlock_bytes);
}

types::Status try_fifo(int priority) {
  sched_param old_param{};
  int old_policy = 0;
  ::pthread_getschedparam(::pthread_self(), &old_policy, &old_param);
  if (const int error = set_fifo(priority); error != 0) {
    return refused(fmt::format("no SCHED_FIFO {} (LimitRTPRIO, or root)", priority), error);
  }
  ::pthread_setschedparam(::pthread_self(), old_policy, &old_param);
  return {};
}

}  // namespace topo::daemon
