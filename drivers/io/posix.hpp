// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cerrno>
#include <string>
#include <string_view>

#include "core/types/result.hpp"
#include "core/types/stamp.hpp"

namespace topo::io {

/// Repeats the call while a signal interrupts it. `call` returns -1 and sets errno on failure.
template <class Call>
auto retry_interrupted(Call&& call) {
  auto result = call();
  while (result == -1 && errno == EINTR) result = call();
  return result;
}

/// CLOCK_MONOTONIC: the host's steady clock, which stamps every read.
[[nodiscard]] types::Stamp monotonic_now();

/// Sleeps until CLOCK_MONOTONIC reaches `when`; returns at once when that has passed. Resumes after a signal.
void sleep_until(types::Stamp when);

/// "DEVICE: DOING: message of the operating system", with the code that corresponds to the errno.
[[nodiscard]] types::Error error_of_errno(std::string_view device, std::string_view doing, int error);
[[nodiscard]] tl::unexpected<types::Error> fail_errno(std::string_view device, std::string_view doing,
                                                      int error);

/// As fail_errno; for a refused device file, the message names the group that has access.
[[nodiscard]] tl::unexpected<types::Error> fail_open(const std::string& path, int error);

/// The events that poll(2) reports for one descriptor within `timeout`; 0 when there are none, -1 with errno
/// on failure. Resumes after a signal. A negative time-out counts as 0.
[[nodiscard]] int wait_for(int fd, short events, types::Duration timeout);

}  // namespace topo::io
