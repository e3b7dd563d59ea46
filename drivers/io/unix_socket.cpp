// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/io/unix_socket.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "drivers/io/posix.hpp"

namespace topo::io {
namespace {

using types::Errc;
using types::fail;
using types::Result;
using types::Status;

/// A socket for messages: its kind and its path.
struct Named {
  const SocketKind& kind;
  const std::string& path;
  [[nodiscard]] std::string text() const { return fmt::format("{} {}", kind.name, path); }
};

tl::unexpected<types::Error> fail_path(const Named& socket, std::string_view doing) {
  const int error = errno;
  const Errc code = error == EACCES || error == EPERM ? Errc::kPermission
                    : error == ENOENT                 ? Errc::kNotFound
                    : error == ECONNREFUSED           ? Errc::kNotFound
                                                      : Errc::kIo;
  return fail(code, fmt::format("{}: {}: {}", socket.text(), doing, std::strerror(error)), error);
}

Result<sockaddr_un> to_address(const Named& socket) {
  const std::string& path = socket.path;
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.empty() || path.size() >= sizeof address.sun_path) {
    return fail(Errc::kInvalidInput, fmt::format("{}: expected a path of 1 to {} bytes", socket.text(),
                                                 sizeof address.sun_path - 1));
  }
  std::memcpy(address.sun_path, path.c_str(), path.size() + 1);
  return address;
}

const sockaddr* generic(const sockaddr_un& address) {
  return reinterpret_cast<const sockaddr*>(&address);  // type that the socket calls expect
}

constexpr mode_t kLockMode = 0600;
// Connections that wait to be accepted: room for a flood of them, so that nobody is turned away meanwhile.
constexpr int kBacklog = 512;

std::string lock_path_of(const std::string& path) { return path + ".lock"; }

/// For fcntl(): the whole file.
struct flock whole_file() {
  struct flock range {};
  range.l_type = F_WRLCK;
  range.l_whence = SEEK_SET;
  return range;
}

/// Only its owner may open the lock file: any process that may read it can lock it, and keep the daemon from
/// starting.
Status check_own(const UniqueFd& lock, const Named& lock_file) {
  const std::string& lock_path = lock_file.path;
  struct stat status {};
  if (::fstat(lock.get(), &status) != 0) return fail_path(lock_file, "cannot be examined");
  if (!S_ISREG(status.st_mode)) {
    return fail(Errc::kInvalidInput, fmt::format("{}'s lock {}: found no regular file, expected one or none",
                                                 lock_file.kind.name, lock_path));
  }
  if (status.st_uid != ::geteuid()) {
    return fail(Errc::kPermission,
                fmt::format("{}'s lock {}: found a file of user {}, expected one of user {}, who runs "
                            "this; remove it when no daemon of the other user runs",
                            lock_file.kind.name, lock_path, status.st_uid, ::geteuid()));
  }
  if ((status.st_mode & 07777) != kLockMode && ::fchmod(lock.get(), kLockMode) != 0)
    return fail_path(lock_file, "its permissions cannot be set");
  return {};
}

/// Two locks. The kernel reports the holder of an fcntl() lock, but a process that opens the file again takes
/// that lock a second time and loses it at close. A flock() lock does not have this fault, but its holder is
/// not reported.
Result<UniqueFd> take_lock(const Named& socket) {
  const std::string lock_path = lock_path_of(socket.path);
  const Named lock_file{socket.kind, lock_path};
  UniqueFd lock(::open(lock_path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, kLockMode));
  if (!lock.valid()) return fail_path(lock_file, "cannot be opened");
  if (auto own = check_own(lock, lock_file); !own) return tl::unexpected(own.error());
  if (::flock(lock.get(), LOCK_EX | LOCK_NB) == 0) {
    struct flock range = whole_file();
    static_cast<void>(::fcntl(lock.get(), F_SETLK, &range));  // on failure only the process id is unknown
    return lock;
  }
  if (errno != EWOULDBLOCK) return fail_path(lock_file, "cannot be locked");
  return fail(Errc::kBusy,
              fmt::format("{}: another process serves it; stop that one, or give this one another {}",
                          socket.text(), socket.kind.name));
}

/// With the lock held, an existing socket belongs to no process.
Status remove_stale(const Named& socket) {
  const std::string& path = socket.path;
  struct stat status {};
  if (::lstat(path.c_str(), &status) != 0) {
    if (errno == ENOENT) return {};
    return fail_path(socket, "cannot be examined");
  }
  if (!S_ISSOCK(status.st_mode)) {
    return fail(Errc::kInvalidInput,
                fmt::format("{}: a file that is no socket is there, expected none", socket.text()));
  }
  if (::unlink(path.c_str()) != 0) return fail_path(socket, "the old socket cannot be removed");
  return {};
}

Status limit_sends(int socket, types::Duration patience, const Named& name) {
  const auto us = std::max<std::int64_t>(
      std::chrono::duration_cast<std::chrono::microseconds>(patience).count(), 1);  // 0 would be no limit
  const timeval limit{us / 1'000'000, us % 1'000'000};
  if (::setsockopt(socket, SOL_SOCKET, SO_SNDTIMEO, &limit, sizeof limit) != 0)
    return fail_path(name, "no time limit");
  return {};
}

tl::unexpected<types::Error> fail_unanswered(const Named& socket) {
  return fail(Errc::kTimeout, fmt::format("{}: who serves it does not answer", socket.text()));
}

/// A connected socket; an invalid one when a signal interrupted the call.
Result<UniqueFd> try_connect(const Named& name, const sockaddr_un& address, types::Duration patience) {
  UniqueFd socket(::socket(AF_UNIX, name.kind.type | SOCK_CLOEXEC, 0));
  if (!socket.valid()) return fail_path(name, "no socket");
  if (auto limited = limit_sends(socket.get(), patience, name); !limited)
    return tl::unexpected(limited.error());
  if (::connect(socket.get(), generic(address), sizeof address) == 0) return socket;
  if (errno == EINTR) return UniqueFd();
  if (errno == EAGAIN) return fail_unanswered(name);
  return fail_path(name, "nobody answers");
}

}  // namespace

Result<ListeningSocket> ListeningSocket::open(const std::string& path, mode_t mode, const SocketKind& kind) {
  const Named name{kind, path};
  const auto address = to_address(name);
  if (!address) return tl::unexpected(address.error());
  auto lock = take_lock(name);
  if (!lock) return tl::unexpected(lock.error());
  if (const auto removed = remove_stale(name); !removed) return tl::unexpected(removed.error());
  UniqueFd socket(::socket(AF_UNIX, kind.type | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  if (!socket.valid()) return fail_path(name, "no socket");
  if (::bind(socket.get(), generic(*address), sizeof *address) != 0) return fail_path(name, "cannot be made");
  if (::chmod(path.c_str(), mode) != 0) return fail_path(name, "its permissions cannot be set");
  if (::listen(socket.get(), kBacklog) != 0) return fail_path(name, "cannot listen");
  return ListeningSocket(std::move(*lock), std::move(socket), path);
}

ListeningSocket::~ListeningSocket() {
  // The lock file stays: otherwise a third daemon could lock a new file while another still holds the removed
  // one.
  if (socket_.valid()) ::unlink(path_.c_str());
}

pid_t serving_process(const std::string& path) {
  const UniqueFd lock(::open(lock_path_of(path).c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
  struct flock range = whole_file();
  if (!lock.valid() || ::fcntl(lock.get(), F_GETLK, &range) != 0) return 0;
  // Any process that may read the file can hold a read lock on it.
  return range.l_type == F_WRLCK ? std::max(range.l_pid, 0) : 0;
}

Result<UniqueFd> connect_unix(const std::string& path, types::Duration patience, const SocketKind& kind) {
  const Named name{kind, path};
  const auto address = to_address(name);
  if (!address) return tl::unexpected(address.error());
  const types::Stamp deadline = monotonic_now() + patience;
  auto socket = try_connect(name, *address, patience);
  // POSIX continues connecting an interrupted socket, Linux does not: a new socket is correct for both.
  while (socket && !socket->valid()) {
    const types::Duration left = deadline - monotonic_now();
    if (left <= types::Duration::zero()) return fail_unanswered(name);
    socket = try_connect(name, *address, left);
  }
  if (!socket) return socket;
  if (auto limited = limit_sends(socket->get(), patience, name); !limited)
    return tl::unexpected(limited.error());
  return socket;
}

}  // namespace topo::io
