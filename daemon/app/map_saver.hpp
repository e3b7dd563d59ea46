// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "core/types/result.hpp"
#include "daemon/app/map_doubter.hpp"
#include "daemon/threads/hand_overs.hpp"

namespace topo::daemon {

/// Summary of the saved files.
struct SavedMap {
  std::string folder;
  std::uint64_t revision = 0;
  int width = 0;
  int height = 0;
  std::size_t points = 0;
  std::size_t places = 0;
  std::size_t goals = 0;
  std::string doubted;  ///< why the map is doubted; empty: it is not
};

/// Writes the map's files. Blocks on the disk; one thread at a time.
class MapSaver {
 public:
  explicit MapSaver(HandOvers& hand_overs)
      : snapshots_(hand_overs.mapping.map->reader(kFilesReader)),
        reports_(hand_overs.planning->reader(kFilesReader)) {}

  /// Writes map.pgm, map.yaml, cloud.ply, trajectory.txt, doubt.json and, when the map was analysed,
  /// goals.json, places.geojson and overview.png into `folder`, which is created when its parent exists.
  /// Every file is written atomically. `doubt`: what speaks against the map; null: that is not known, and
  /// there is no doubt.json. kNotFound before the first scan was matched.
  types::Result<SavedMap> save(const std::string& folder, const FoundDoubt* doubt);

 private:
  types::Status save_analysis(const std::string& folder, const pipeline::MapSnapshot& map,
                              const FoundDoubt* doubt, SavedMap& saved);

  MapSnapshots::Reader snapshots_;
  PlanningReports::Reader reports_;
};

}  // namespace topo::daemon
