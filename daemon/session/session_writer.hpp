// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/slam/session.hpp"
#include "core/types/result.hpp"

namespace topo::daemon {

/// Pose change up to which a pose is not written again; zero: every change is written.
struct PoseTolerance {
  double trans_m = 0.0;
  double rot_rad = 0.0;
};

/// State of a growing session's file, and the records that bring it up to date.
class SessionWriter {
 public:
  /// Records with everything in `session` that the file lacks: new keyframes, edges from the first new or
  /// changed one, poses from the first new or moved one. May be repeated: written() updates the state after
  /// the records are in the file. kInvalidInput when a keyframe is too large for a record.
  [[nodiscard]] types::Result<std::vector<std::byte>> changes(const slam::Session& session,
                                                              const PoseTolerance& tolerance);
  /// To be called when the last changes() of `session` are in the file.
  void written(const slam::Session& session, const PoseTolerance& tolerance);

  /// The record that marks the file as closed in order.
  [[nodiscard]] std::vector<std::byte> end() const;

 private:
  [[nodiscard]] std::size_t first_moved(const slam::Session& session, const PoseTolerance& tolerance) const;
  [[nodiscard]] std::size_t first_other_edge(const slam::Session& session) const;
  std::uint32_t records_ = 0;  ///< in the file
  std::uint32_t pending_ = 0;  ///< in the last changes()
  std::size_t keyframes_ = 0;
  std::vector<slam::Edge> edges_;
  std::vector<types::Se2> poses_;
};

/// Writes a whole session atomically (mapfile/atomic_file.hpp). Blocks on the disk.
[[nodiscard]] types::Status save_session(const std::string& path, const slam::Session& session,
                                         std::uint64_t params_hash);

/// The bytes that save_session() writes.
[[nodiscard]] types::Result<std::vector<std::byte>> session_bytes(const slam::Session& session,
                                                                  std::uint64_t params_hash);

}  // namespace topo::daemon
