// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/config/replayed.hpp"

namespace topo::daemon {

LoadedConfiguration replayed(LoadedConfiguration loaded, const std::string& sessions) {
  loaded.values.session.folder = sessions;
  loaded.values.session.resume.clear();
  loaded.values.exploration.save_folder.clear();
  loaded.values.control.state_folder.clear();
  loaded.values.team = {};  // what is played again is not said to others again
  std::erase_if(loaded.places, [](const auto& key) { return key.first.starts_with("team."); });
  for (const char* key :
       {"session.folder", "session.resume", "exploration.save_folder", "control.state_folder"})
    loaded.places.erase(key);
  return loaded;
}

}  // namespace topo::daemon
