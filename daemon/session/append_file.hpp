// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "core/types/result.hpp"
#include "drivers/io/unique_fd.hpp"

namespace topo::daemon {

/// A file that grows by whole pieces: each is on the disk completely or, after an error, not at all, so that
/// later pieces follow a whole one. Marked as being written (recording/quota.hpp). Blocks on the disk.
class AppendFile {
 public:
  /// Creates a new file; kInvalidInput when the name exists. `what` is named in errors.
  static types::Result<AppendFile> create(const std::string& path, const std::string& what);

  /// Appends a piece, and brings it to the disk. On failure the file is unchanged.
  types::Status append(std::span<const std::byte> piece);

  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] std::uint64_t bytes() const { return size_; }

 private:
  AppendFile(std::string path, std::string name, io::UniqueFd fd)
      : path_(std::move(path)), name_(std::move(name)), fd_(std::move(fd)) {}
  tl::unexpected<types::Error> take_back(const std::string& doing, int error);

  std::string path_;
  std::string name_;  ///< without its folder; used in errors
  io::UniqueFd fd_;
  std::uint64_t size_ = 0;
};

}  // namespace topo::daemon
