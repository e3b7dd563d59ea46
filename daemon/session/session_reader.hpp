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
};

/// The session of a file's bytes, up to its last whole record: a cut or damaged file gives what was written
/// before. kInvalidInput when its beginning is no session, or what it holds is none. Hostile bytes are safe.
[[nodiscard]] types::Result<LoadedSession> parse_session(std::span<const std::byte> file);

/// The same of a file; errors name it. Blocks on the disk.
[[nodiscard]] types::Result<LoadedSession> load_session(const std::string& path);

}  // namespace topo::daemon
