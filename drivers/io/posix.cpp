// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/io/posix.hpp"

#include <grp.h>
#include <poll.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <system_error>
#include <utility>

namespace topo::io {
namespace {

using types::Duration;
using types::Errc;
using types::Stamp;

Errc errc_of(int error) {
  switch (error) {
    case ENOENT:
    case ENODEV:
    case ENXIO:
    case EHOSTUNREACH:
    case ENETUNREACH:
    case ECONNREFUSED:
      return Errc::kNotFound;
    case EACCES:
    case EPERM:
      return Errc::kPermission;
    case EBUSY:
    case EAGAIN:
      return Errc::kBusy;
    case ETIMEDOUT:
      return Errc::kTimeout;
    case EPIPE:
    case ECONNRESET:
      return Errc::kClosed;
    default:
      return Errc::kIo;
  }
}

/// The group that owns a device file; "dialout" when that is root or unknown.
std::string group_of(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) == 0 && status.st_gid != 0) {
    std::array<char, 1024> buffer{};
    struct group entry {};
    struct group* found = nullptr;
    if (::getgrgid_r(status.st_gid, &entry, buffer.data(), buffer.size(), &found) == 0 && found != nullptr) {
      return found->gr_name;
    }
  }
  return "dialout";
}

timespec to_timespec(Duration d) {
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(d);
  timespec out{};
  out.tv_sec = seconds.count();
  out.tv_nsec = (d - seconds).count();
  return out;
}

}  // namespace

Stamp monotonic_now() {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return Stamp{std::chrono::seconds(now.tv_sec) + std::chrono::nanoseconds(now.tv_nsec)};
}

void sleep_until(Stamp when) {
  const timespec at = to_timespec(std::max(when.time_since_epoch(), Duration::zero()));
  while (::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &at, nullptr) == EINTR) {
  }
}

types::Error error_of_errno(std::string_view device, std::string_view doing, int error) {
  std::string message;
  message.append(device).append(": ").append(doing).append(": ");
  message.append(std::generic_category().message(error));
  return {errc_of(error), std::move(message), error};
}

tl::unexpected<types::Error> fail_errno(std::string_view device, std::string_view doing, int error) {
  return tl::unexpected<types::Error>(error_of_errno(device, doing, error));
}

tl::unexpected<types::Error> fail_open(const std::string& path, int error) {
  types::Error failure = error_of_errno(path, "cannot open", error);
  if (failure.code == Errc::kPermission) {
    const std::string group = group_of(path);
    failure.message +=
        "; the user of this program must be in the group " + group + " (as root: adduser USER " + group + ")";
  }
  if (failure.code == Errc::kNotFound) failure.message += "; is the device plugged in and powered?";
  return tl::unexpected<types::Error>(std::move(failure));
}

int wait_for(int fd, short events, Duration timeout) {
  const Stamp deadline = monotonic_now() + std::max(timeout, Duration::zero());
  for (;;) {
    const timespec left = to_timespec(std::max(deadline - monotonic_now(), Duration::zero()));
    pollfd entry{fd, events, 0};
    const int ready = ::ppoll(&entry, 1, &left, nullptr);
    if (ready > 0) return entry.revents;
    if (ready == 0) return 0;
    if (errno != EINTR) return -1;
  }
}

}  // namespace topo::io
