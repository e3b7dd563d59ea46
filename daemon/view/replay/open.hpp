// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "daemon/view/replay/story.hpp"

namespace topo::daemon {

/// What there is to play.
struct Played {
  std::string name;  ///< of the session
  MapHistory map;
  Story story;
  std::string log;  ///< its file; empty: there is none
};

/// The path of what is played: a session's file, or the newest journal of a folder. kNotFound: there is none;
/// kInvalidInput: a recording, or another file.
[[nodiscard]] types::Result<std::string> find_session(const std::string& path);

/// True for a recording (topometricd --record).
[[nodiscard]] bool is_recording(const std::string& path);

/// Reads a session and the mission log beside it: of the logs in its folder that were begun by the time at
/// which its journal was (by its name; a saved session: was written), the newest. Blocks on the disk.
[[nodiscard]] types::Result<Played> load_played(const std::string& session);

}  // namespace topo::daemon
