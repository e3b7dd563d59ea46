// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/mapfile/input_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

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

Result<std::string> read_file(const std::string& path, std::size_t max_bytes) {
  const io::UniqueFd fd(io::retry_interrupted([&] { return ::open(path.c_str(), O_RDONLY | O_CLOEXEC); }));
  struct stat info {};
  if (!fd.valid() || ::fstat(fd.get(), &info) != 0) return io::fail_errno(path, "cannot open", errno);
  if (!S_ISREG(info.st_mode))
    return bad_file(path, "", S_ISDIR(info.st_mode) ? "a directory" : "a special file", "a file");
  const auto size = static_cast<std::size_t>(info.st_size);
  if (size > max_bytes)
    return bad_file(path, "", fmt::format("{} bytes", size), fmt::format("at most {}", max_bytes));
  std::string content(size, '\0');
  std::size_t done = 0;
  while (done < size) {
    const auto n =
        io::retry_interrupted([&] { return ::read(fd.get(), content.data() + done, size - done); });
    if (n < 0) return io::fail_errno(path, "cannot read", errno);
    if (n == 0) break;
    done += static_cast<std::size_t>(n);
  }
  content.resize(done);
  return content;
}

}  // namespace topo::daemon
