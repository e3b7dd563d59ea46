// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "core/slam/session.hpp"
#include "core/types/result.hpp"
#include "daemon/session/session_writer.hpp"
#include "drivers/io/unique_fd.hpp"

namespace topo::daemon {

/// The growing file of a session: appended to while mapping goes on, so that a killed daemon's map is there
/// up to the last append. What the disk did not take is kept back and comes with the next append.
class JournalFile {
 public:
  /// A new file; kInvalidInput when there is one of that name.
  static types::Result<JournalFile> create(const std::string& path, std::uint64_t params_hash);

  /// Appends what `session` has more, and brings it to the disk. When that fails the file ends where it did
  /// before. True when there was something.
  types::Result<bool> append(const slam::Session& session);
  /// The exact poses and the record that says that it was closed in order.
  types::Status close(const slam::Session& session);

  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] std::uint64_t bytes() const { return size_; }

 private:
  JournalFile(std::string path, std::string name, io::UniqueFd fd)
      : path_(std::move(path)), name_(std::move(name)), fd_(std::move(fd)) {}
  types::Status write(std::span<const std::byte> bytes);
  tl::unexpected<types::Error> take_back(const std::string& doing, int error);
  std::string path_;
  std::string name_;  ///< without its folder; errors name it
  io::UniqueFd fd_;
  std::uint64_t size_ = 0;
  SessionWriter writer_;
};

}  // namespace topo::daemon
