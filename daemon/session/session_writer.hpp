// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/slam/session.hpp"
#include "core/types/result.hpp"

namespace topo::daemon {

/// How far poses may have moved before they are worth writing again; zero: at all.
struct PoseTolerance {
  double trans_m = 0.0;
  double rot_rad = 0.0;
};

/// What a file holds of a growing session, and what is to be appended to bring it up to date.
class SessionWriter {
 public:
  /// Records with everything in `session` that the file lacks: new keyframes, edges from the first one that
  /// is new or another, poses from the first one that is new or moved. Changes nothing: written() does, once
  /// they are in the file. kInvalidInput when a keyframe is too large for a record.
  [[nodiscard]] types::Result<std::vector<std::byte>> changes(const slam::Session& session,
                                                              const PoseTolerance& tolerance) const;
  /// The last changes() of `session` are in the file.
  void written(const slam::Session& session, const PoseTolerance& tolerance);

  /// The record that says that the file was closed in order.
  [[nodiscard]] std::vector<std::byte> end() const;

 private:
  [[nodiscard]] std::size_t first_moved(const slam::Session& session, const PoseTolerance& tolerance) const;
  [[nodiscard]] std::size_t first_other_edge(const slam::Session& session) const;
  std::size_t keyframes_ = 0;
  std::vector<slam::Edge> edges_;
  std::vector<types::Se2> poses_;
};

/// Writes a whole session: there as a whole or not at all, whatever is killed meanwhile
/// (mapfile/atomic_file.hpp). Blocks on the disk.
[[nodiscard]] types::Status save_session(const std::string& path, const slam::Session& session,
                                         std::uint64_t params_hash);

/// The bytes that save_session writes.
[[nodiscard]] types::Result<std::vector<std::byte>> session_bytes(const slam::Session& session,
                                                                  std::uint64_t params_hash);

}  // namespace topo::daemon
