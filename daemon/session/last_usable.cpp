// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/session/last_usable.hpp"

#include <utility>

namespace topo::daemon {

types::Result<UsableSession> load_usable(const SessionEntry& entry) {
  auto loaded = load_session(entry.path);
  if (!loaded) return tl::unexpected(loaded.error());
  if (const types::Status sound = check_map(*loaded, entry.path); !sound)
    return tl::unexpected(sound.error());
  return UsableSession{entry, std::move(*loaded)};
}

LastUsable last_usable_journal(const std::vector<SessionEntry>& sessions) {
  LastUsable last;
  for (auto entry = sessions.rbegin(); entry != sessions.rend() && !last.session; ++entry) {
    if (!entry->journal) continue;
    auto usable = load_usable(*entry);
    if (usable)
      last.session = std::move(*usable);
    else
      last.unusable.push_back(usable.error().message);
  }
  return last;
}

}  // namespace topo::daemon
