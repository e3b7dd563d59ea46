// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "daemon/session/folder.hpp"
#include "daemon/session/session_reader.hpp"

namespace topo::daemon {

/// A session and its content.
struct UsableSession {
  SessionEntry entry;
  LoadedSession loaded;  ///< check_map() holds
};

/// The last journal in which there is a map, and the later ones that were passed over for it.
struct LastUsable {
  std::optional<UsableSession> session;  ///< nothing: there is no journal, or no usable one
  std::vector<std::string> unusable;     ///< why the later ones cannot be used, the last one first
};

/// A session with a map in it, or why it is none; errors name the file. Blocks on the disk.
[[nodiscard]] types::Result<UsableSession> load_usable(const SessionEntry& entry);

/// Tries the journals from the last one on: an empty or unreadable one, as a full disk or a loss of power
/// leaves it, does not hide the one before. Blocks on the disk.
[[nodiscard]] LastUsable last_usable_journal(const std::vector<SessionEntry>& sessions);

}  // namespace topo::daemon
