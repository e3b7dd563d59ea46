// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/slam/session.hpp"
#include "core/types/result.hpp"
#include "daemon/session/mend.hpp"
#include "daemon/session/record_scan.hpp"

namespace topo::daemon {

/// A session as read from its file.
struct LoadedSession {
  slam::Session session;          ///< checked
  std::uint64_t params_hash = 0;  ///< 0 when the header is damaged
  bool closed = false;      ///< the file was closed in order; false: its writer was killed or still writes
  std::size_t bytes = 0;    ///< bytes of the file that were read
  std::size_t damaged = 0;  ///< all others
  bool cut = false;         ///< the last of them are the beginning of a record
  std::vector<DamagedPiece> pieces;  ///< the damaged bytes
  std::uint64_t records_lost = 0;    ///< as far as the file shows
  Mended mended;                     ///< all zero: nothing was to be mended
};

/// Description of a file's damage for users: where it is, how much it is and what was lost by it; or that the
/// file was not closed; empty when it was closed in order.
[[nodiscard]] std::string damage_text(const LoadedSession& loaded);

/// Reads a session from a file's bytes. Every record has its checksum: behind a damaged one reading goes on
/// with the next whole one, and what is left is mended (mend.hpp). A file that was only cut gives what was
/// whole before. kInvalidInput when neither the header nor any record is whole, when the version is another
/// one, or when the session is invalid. Safe for untrusted input.
[[nodiscard]] types::Result<LoadedSession> parse_session(std::span<const std::byte> file);

/// The bytes of a session's file; errors name it. Blocks on the disk.
[[nodiscard]] types::Result<std::string> read_session_file(const std::string& path);

/// As parse_session(), for a file; errors name it. Blocks on the disk.
[[nodiscard]] types::Result<LoadedSession> load_session(const std::string& path);

/// Checks that there is a map; kInvalidInput, with the file's damage, when no keyframe is left.
[[nodiscard]] types::Status check_map(const LoadedSession& loaded, const std::string& path);

/// Why a file is not a session of a version that is read, from its header alone; empty when it may be one.
/// Blocks on the disk.
[[nodiscard]] std::string header_fault(const std::string& path);

}  // namespace topo::daemon
