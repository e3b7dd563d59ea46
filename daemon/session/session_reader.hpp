// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "core/slam/session.hpp"
#include "core/types/result.hpp"

namespace topo::daemon {

/// A session as read from its file.
struct LoadedSession {
  slam::Session session;  ///< checked
  std::uint64_t params_hash = 0;
  bool closed = false;      ///< the file ends in order; false: its writer was killed or still writes
  std::size_t bytes = 0;    ///< bytes of the file that were read
  std::size_t damaged = 0;  ///< bytes after them that could not be read
  bool cut = false;         ///< the unread bytes are the beginning of a record
};

/// Description of a file's damage for users: the position at which it is truncated or damaged, or that it was
/// not closed; empty when it was closed in order.
[[nodiscard]] std::string damage_text(const LoadedSession& loaded);

/// Reads a session from a file's bytes, up to its last complete record: a truncated or damaged file gives the
/// data before the damage. kInvalidInput when the header or the session is invalid. Safe for untrusted input.
[[nodiscard]] types::Result<LoadedSession> parse_session(std::span<const std::byte> file);

/// As parse_session(), for a file; errors name it. Blocks on the disk.
[[nodiscard]] types::Result<LoadedSession> load_session(const std::string& path);

/// Checks that there is a map; kInvalidInput, with the file's damage, when no keyframe is left.
[[nodiscard]] types::Status check_map(const LoadedSession& loaded, const std::string& path);

/// Why a file is not a session of this version, from its header alone; empty when it may be one. Blocks on
/// the disk.
[[nodiscard]] std::string header_fault(const std::string& path);

}  // namespace topo::daemon
