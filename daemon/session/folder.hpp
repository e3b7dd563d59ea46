// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/types/result.hpp"
#include "daemon/recording/quota.hpp"

namespace topo::daemon {

/// A session's file in the folder of sessions.
struct SessionEntry {
  std::string name;  ///< without ".session"
  std::string path;
  std::uint64_t bytes = 0;
  std::int64_t written_s = 0;  ///< last change, seconds since 1970
  bool journal = false;
};

/// 1 to 64 letters, digits, - and _.
[[nodiscard]] bool is_session_name(std::string_view name);
/// True for names that the daemon reserves: "journal-...".
[[nodiscard]] bool is_journal_name(std::string_view name);
/// The file of a session in a folder.
[[nodiscard]] std::string session_path(const std::string& folder, std::string_view name);

/// The sessions in a folder, by name. Blocks on the disk. kNotFound when there is no such folder.
[[nodiscard]] types::Result<std::vector<SessionEntry>> list_sessions(const std::string& folder);

/// The last journal by name; nothing when there is none.
[[nodiscard]] std::optional<SessionEntry> newest_journal(const std::vector<SessionEntry>& sessions);

/// Name for a journal begun at `seconds` since 1970 that sorts after all of `sessions`, independent of the
/// clock: "journal-20260102T030405Z", with a number appended where the time alone does not sort last.
[[nodiscard]] std::string next_journal_name(std::int64_t seconds, const std::vector<SessionEntry>& sessions);

/// Removes the oldest journals until `keep` remain; saved sessions and journals that are being written stay.
/// Returns the number removed.
std::size_t remove_old_journals(const std::vector<SessionEntry>& sessions, std::size_t keep);

/// Removes the oldest journals until all journals have at most `quota_bytes` (recording/quota.hpp); saved
/// sessions neither count nor go.
QuotaResult keep_journals_to_quota(const std::vector<SessionEntry>& sessions, std::uint64_t quota_bytes);

}  // namespace topo::daemon
