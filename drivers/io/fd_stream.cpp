// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/io/fd_stream.hpp"

#include <poll.h>
#include <utility>

#include "drivers/io/posix.hpp"

namespace topo::io {
namespace {

using types::Errc;
using types::fail;

constexpr short kGoneEvents = POLLHUP | POLLERR | POLLNVAL;

/// An unplugged device reports EIO, ENXIO or ENODEV; a lost peer reports one of the others.
bool means_gone(int error) {
  return error == EIO || error == ENXIO || error == ENODEV || error == EPIPE || error == ECONNRESET ||
         error == ETIMEDOUT || error == EHOSTUNREACH || error == ENETUNREACH || error == ENOTCONN;
}

tl::unexpected<types::Error> fail_stream(const std::string& name, std::string_view doing, int error) {
  types::Error failure = error_of_errno(name, doing, error);
  if (means_gone(error)) failure.code = Errc::kClosed;
  return tl::unexpected<types::Error>(std::move(failure));
}

tl::unexpected<types::Error> fail_hung_up(const std::string& name) {
  return fail(Errc::kClosed, name + ": the device was unplugged or closed the connection");
}

}  // namespace

Result<ReadResult> FdStream::read(std::span<std::byte> buffer, Duration timeout) {
  const int events = wait_for(fd(), POLLIN, timeout);
  const Stamp stamp = monotonic_now();
  if (events < 0) return fail_stream(name_, "waiting for input", errno);
  if (events == 0 || buffer.empty()) return ReadResult{0, stamp};
  // Hang-up and waiting bytes may be reported together: the bytes are read first.
  const ssize_t got = retry_interrupted([&] { return ::read(fd(), buffer.data(), buffer.size()); });
  if (got > 0) return ReadResult{static_cast<std::size_t>(got), stamp};
  if (got == 0) return fail_hung_up(name_);
  if (errno != EAGAIN) return fail_stream(name_, "reading", errno);
  if ((events & kGoneEvents) != 0) return fail_hung_up(name_);
  return ReadResult{0, stamp};
}

Status FdStream::write(std::span<const std::byte> bytes, Duration timeout) {
  const Stamp deadline = monotonic_now() + timeout;
  while (!bytes.empty()) {
    const ssize_t took = retry_interrupted([&] { return write_some(bytes); });
    if (took > 0) {
      bytes = bytes.subspan(static_cast<std::size_t>(took));
      continue;
    }
    if (took < 0 && errno != EAGAIN) return fail_stream(name_, "writing", errno);
    const int events = wait_for(fd(), POLLOUT, deadline - monotonic_now());
    if (events < 0) return fail_stream(name_, "waiting to write", errno);
    if (events == 0) return fail(Errc::kTimeout, name_ + ": the device does not take what is written to it");
    if ((events & kGoneEvents) != 0) return fail_hung_up(name_);
  }
  return {};
}

Stamp FdStream::now() const { return monotonic_now(); }

}  // namespace topo::io
