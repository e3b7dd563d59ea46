// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "daemon/config/key_table.hpp"
#include "daemon/config/load.hpp"

namespace topo::daemon {

std::string faults_text(const LoadedConfiguration& loaded) {
  std::string text;
  for (const auto& fault : loaded.faults) {
    text += fmt::format("{}:{}:{}: {}\n", loaded.file, fault.place.line, fault.place.column, fault.message);
  }
  return text;
}

std::string effective_text(const LoadedConfiguration& loaded) {
  std::string text;
  std::string_view section;
  for (const auto& key : key_table()) {
    if (key.section() == "scanner.coronal" && !loaded.values.coronal.present) continue;
    if (key.section() == "team" && !loaded.values.team.present) continue;
    if (key.section() != section) {
      text += fmt::format("{}[{}]\n", section.empty() ? "" : "\n", key.section());
      section = key.section();
    }
    const auto place = loaded.places.find(key.path);
    const std::string origin =
        place == loaded.places.end() ? "default" : fmt::format("{}:{}", loaded.file, place->second.line);
    text += fmt::format("{} = {}  # {}\n", key.name(), value_text(key, loaded.values), origin);
  }
  return text;
}

}  // namespace topo::daemon
