// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "core/slam/session.hpp"
#include "core/types/result.hpp"

namespace topo::daemon {

/// A session as its file holds it.
struct LoadedSession {
  slam::Session session;  ///< checked
  std::uint64_t params_hash = 0;
  bool closed = false;      ///< the file ends in order; false: its writer was killed or is still at it
  std::size_t bytes = 0;    ///< of the file that were understood
  std::size_t damaged = 0;  ///< bytes after them that were not
  bool cut = false;         ///< they are the beginning of a record
};

/// What the file lacks, for a person: where it was cut or damaged, or that it was never closed; empty when it
/// ends in order.
[[nodiscard]] std::string damage_text(const LoadedSession& loaded);

/// The session of a file's bytes, up to its last whole record: a cut or damaged file gives what was written
/// before. kInvalidInput when its beginning is no session, or what it holds is none. Hostile bytes are safe.
[[nodiscard]] types::Result<LoadedSession> parse_session(std::span<const std::byte> file);

/// The same of a file; errors name it. Blocks on the disk.
[[nodiscard]] types::Result<LoadedSession> load_session(const std::string& path);

/// Whether there is a map in it; kInvalidInput, with what the file lacks, when no keyframe is left.
[[nodiscard]] types::Status check_map(const LoadedSession& loaded, const std::string& path);

/// Why a file is no session of this version, by its header alone; empty when it may be one. Blocks on the
/// disk.
[[nodiscard]] std::string header_fault(const std::string& path);

}  // namespace topo::daemon
