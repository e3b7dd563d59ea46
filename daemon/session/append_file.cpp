// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/session/append_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>

#include "daemon/recording/quota.hpp"
#include "drivers/io/folder_sync.hpp"
#include "drivers/io/posix.hpp"

namespace topo::daemon {

using types::Errc;
using types::Result;
using types::Status;

Result<AppendFile> AppendFile::create(const std::string& path, const std::string& what) {
  // Without the folder, for a report of bounded length: the folder is in the configuration.
  std::string name = std::filesystem::path(path).filename().string();
  io::UniqueFd fd(io::retry_interrupted(
      [&] { return ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644); }));
  if (!fd.valid()) {
    if (errno == EEXIST)
      return types::fail(Errc::kInvalidInput, fmt::format("{}: there is such a file already", name), EEXIST);
    return io::fail_errno(name, "cannot create the " + what, errno);
  }
  mark_as_written(fd.get());
  if (auto kept = io::sync_folder_of(path); !kept) {
    ::unlink(path.c_str());
    return tl::unexpected(kept.error());
  }
  return AppendFile(path, std::move(name), std::move(fd));
}

/// Truncates the file: part of a piece, or the rest of a longer one, would hide all later pieces from a
/// reader.
tl::unexpected<types::Error> AppendFile::take_back(const std::string& doing, int error) {
  static_cast<void>(::ftruncate(fd_.get(), static_cast<off_t>(size_)));
  return io::fail_errno(name_, doing, error);
}

Status AppendFile::append(std::span<const std::byte> piece) {
  std::size_t done = 0;
  while (done < piece.size()) {
    const auto n = io::retry_interrupted([&] {
      return ::pwrite(fd_.get(), piece.data() + done, piece.size() - done, static_cast<off_t>(size_ + done));
    });
    if (n < 0) return take_back(fmt::format("cannot write {} bytes at byte {}", piece.size(), size_), errno);
    done += static_cast<std::size_t>(n);
  }
  if (::fdatasync(fd_.get()) != 0 && errno != EINVAL) return take_back("cannot bring it to the disk", errno);
  size_ += piece.size();
  return {};
}

}  // namespace topo::daemon
