// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/mapfile/atomic_file.hpp"

#include <fcntl.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <vector>

#include "drivers/io/folder_sync.hpp"
#include "drivers/io/posix.hpp"
#include "drivers/io/unique_fd.hpp"

namespace topo::daemon {

using types::Result;
using types::Status;

namespace {

/// A temporary file, which commit() renames and the destructor removes otherwise.
class Temporary {
 public:
  static Result<Temporary> write(const FileContent& file) {
    std::string name = file.path + ".XXXXXX";
    io::UniqueFd fd(::mkostemp(name.data(), O_CLOEXEC));
    if (!fd.valid()) return io::fail_errno(file.path, "cannot create a file beside it", errno);
    Temporary temporary(name, file.path);
    for (std::span<const std::byte> rest : {file.bytes, file.more}) {
      while (!rest.empty()) {
        const auto n = io::retry_interrupted([&] { return ::write(fd.get(), rest.data(), rest.size()); });
        if (n < 0) return io::fail_errno(file.path, "cannot write", errno);
        rest = rest.subspan(static_cast<std::size_t>(n));
      }
    }
    if (::fchmod(fd.get(), 0644) != 0 || ::fsync(fd.get()) != 0)
      return io::fail_errno(file.path, "cannot bring it to the disk", errno);
    return temporary;
  }

  ~Temporary() {
    if (!name_.empty()) ::unlink(name_.c_str());
  }
  Temporary(Temporary&& other) noexcept
      : name_(std::exchange(other.name_, {})), path_(std::move(other.path_)) {}
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;
  Temporary& operator=(Temporary&&) = delete;

  Status commit() {
    if (::rename(name_.c_str(), path_.c_str()) != 0)
      return io::fail_errno(path_, "cannot put it in place", errno);
    name_.clear();
    return {};
  }

 private:
  Temporary(std::string name, std::string path) : name_(std::move(name)), path_(std::move(path)) {}
  std::string name_;
  std::string path_;
};

}  // namespace

Status write_files(std::span<const FileContent> files) {
  std::vector<Temporary> written;
  for (const FileContent& file : files) {
    auto temporary = Temporary::write(file);
    if (!temporary.has_value()) return tl::unexpected(temporary.error());
    written.push_back(std::move(*temporary));
  }
  for (Temporary& temporary : written) {
    if (auto s = temporary.commit(); !s.has_value()) return s;
  }
  for (const FileContent& file : files) {
    if (auto s = io::sync_folder_of(file.path); !s.has_value()) return s;
  }
  return {};
}

Status remove_file(const std::string& path) {
  struct stat info {};
  // Looked for first: on a disk that is read-only, unlink() fails for a missing file too.
  if (::lstat(path.c_str(), &info) == 0) {
    if (::unlink(path.c_str()) != 0) return io::fail_errno(path, "cannot be removed", errno);
  } else if (errno != ENOENT && errno != ENOTDIR) {
    return io::fail_errno(path, "cannot be examined", errno);
  }
  // Also without a file: an earlier call may have failed after it had removed it.
  const auto folder = std::filesystem::path(path).parent_path();
  std::error_code none;
  return std::filesystem::is_directory(folder, none) ? io::sync_folder_of(path) : Status{};
}

}  // namespace topo::daemon
