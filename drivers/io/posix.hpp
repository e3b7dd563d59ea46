// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cerrno>
#include <string>
#include <string_view>

#include "core/types/result.hpp"
#include "core/types/stamp.hpp"

namespace topo::io {

/// Calls until it is not interrupted by a signal. `call` returns -1 and sets errno on failure.
template <class Call>
auto retry_interrupted(Call&& call) {
  auto result = call();
  while (result == -1 && errno == EINTR) result = call();
  return result;
}

/// CLOCK_MONOTONIC: the host's steady clock, that stamps every read.
[[nodiscard]] types::Stamp monotonic_now();

/// Sleeps until CLOCK_MONOTONIC shows `when`; not at all when that has passed. Goes on after a signal.
void sleep_until(types::Stamp when);

/// "DEVICE: DOING: what the operating system says", under the code that fits the errno.
[[nodiscard]] types::Error error_of_errno(std::string_view device, std::string_view doing, int error);
[[nodiscard]] tl::unexpected<types::Error> fail_errno(std::string_view device, std::string_view doing,
                                                      int error);

/// As fail_errno; a refused device file names the group that has access to it.
[[nodiscard]] tl::unexpected<types::Error> fail_open(const std::string& path, int error);

/// What poll(2) reports for one descriptor within `timeout`; 0 when nothing did, -1 with errno on failure.
/// Goes on waiting after a signal. A negative time-out counts as none.
[[nodiscard]] int wait_for(int fd, short events, types::Duration timeout);

}  // namespace topo::io
