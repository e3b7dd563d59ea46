// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "core/slam/session.hpp"
#include "core/types/result.hpp"
#include "daemon/session/append_file.hpp"
#include "daemon/session/session_writer.hpp"

namespace topo::daemon {

/// The growing file of a session: appended to while mapping runs, so that the map of a killed daemon is saved
/// up to the last append. Data that could not be written are written with the next append.
class JournalFile {
 public:
  /// Creates a new file; kInvalidInput when the name exists.
  static types::Result<JournalFile> create(const std::string& path, std::uint64_t params_hash);

  /// Appends the changes of `session`, and brings them to the disk. On failure the file is unchanged. True
  /// when there were changes.
  types::Result<bool> append(const slam::Session& session);
  /// Appends the exact poses and the record that marks the file as closed in order.
  types::Status close(const slam::Session& session);

  [[nodiscard]] const std::string& path() const { return file_.path(); }
  [[nodiscard]] std::uint64_t bytes() const { return file_.bytes(); }

 private:
  explicit JournalFile(AppendFile file) : file_(std::move(file)) {}
  AppendFile file_;
  SessionWriter writer_;
};

}  // namespace topo::daemon
