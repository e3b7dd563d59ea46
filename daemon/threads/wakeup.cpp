// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/threads/wakeup.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

#include "drivers/io/posix.hpp"

namespace topo::daemon {

Wakeup::Wakeup() : fd_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
  if (fd_.valid()) return;
  std::perror("topometricd: eventfd");  // before the service is ready: it cannot run without wakeups
  std::exit(1);
}

void Wakeup::post() noexcept {
  const std::uint64_t one = 1;
  // Fails only when the counter is full; the waiting thread is then awake already.
  [[maybe_unused]] const ssize_t written = ::write(fd_.get(), &one, sizeof one);
}

bool Wakeup::wait(types::Duration timeout) {
  if (io::wait_for(fd_.get(), POLLIN, timeout) <= 0) return false;
  std::uint64_t count = 0;
  return ::read(fd_.get(), &count, sizeof count) == sizeof count;
}

}  // namespace topo::daemon
