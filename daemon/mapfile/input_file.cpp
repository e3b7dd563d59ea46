// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/mapfile/input_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>

#include "drivers/io/posix.hpp"
#include "drivers/io/unique_fd.hpp"

namespace topo::daemon {

using types::Errc;
using types::Result;

tl::unexpected<types::Error> bad_file(const std::string& path, std::string_view where, std::string_view found,
                                      std::string_view expected) {
  return types::fail(Errc::kInvalidInput, fmt::format("{}: {}{}found {}, expected {}", path, where,
                                                      where.empty() ? "" : ": ", found, expected));
}

namespace {

struct OpenFile {
  io::UniqueFd fd;
  std::size_t size = 0;
};

io::UniqueFd open_to_read(const std::string& path, int more) {
  return io::UniqueFd(
      io::retry_interrupted([&] { return ::open(path.c_str(), O_RDONLY | O_CLOEXEC | more); }));
}

Result<OpenFile> open_file(const std::string& path) {
  // Opening a FIFO would otherwise block until a writer opens it.
  OpenFile file{open_to_read(path, O_NONBLOCK)};
  // A regular file under a lease (fcntl(2)), as used by file servers: opening waits until the lease is
  // released.
  if (!file.fd.valid() && errno == EWOULDBLOCK) file.fd = open_to_read(path, 0);
  struct stat info {};
  if (!file.fd.valid() || ::fstat(file.fd.get(), &info) != 0)
    return io::fail_errno(path, "cannot open", errno);
  if (!S_ISREG(info.st_mode))
    return bad_file(path, "", S_ISDIR(info.st_mode) ? "a directory" : "a special file", "a file");
  file.size = static_cast<std::size_t>(info.st_size);
  return file;
}

Result<std::string> read_bytes(const OpenFile& file, const std::string& path, std::size_t bytes) {
  std::string content(bytes, '\0');
  std::size_t done = 0;
  while (done < bytes) {
    const auto n =
        io::retry_interrupted([&] { return ::read(file.fd.get(), content.data() + done, bytes - done); });
    if (n < 0) return io::fail_errno(path, "cannot read", errno);
    if (n == 0) break;
    done += static_cast<std::size_t>(n);
  }
  content.resize(done);
  return content;
}

}  // namespace

Result<std::string> read_file(const std::string& path, std::size_t max_bytes) {
  const auto file = open_file(path);
  if (!file) return tl::unexpected(file.error());
  if (file->size > max_bytes)
    return bad_file(path, "", fmt::format("{} bytes", file->size), fmt::format("at most {}", max_bytes));
  return read_bytes(*file, path, file->size);
}

Result<std::string> read_beginning(const std::string& path, std::size_t bytes) {
  const auto file = open_file(path);
  if (!file) return tl::unexpected(file.error());
  return read_bytes(*file, path, std::min(file->size, bytes));
}

}  // namespace topo::daemon
