// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "core/types/result.hpp"
#include "daemon/threads/hand_overs.hpp"

namespace topo::daemon {

/// What was written.
struct SavedMap {
  std::string folder;
  std::uint64_t revision = 0;
  int width = 0;
  int height = 0;
  std::size_t points = 0;
  std::size_t places = 0;
  std::size_t goals = 0;
};

/// Writes the map's files. Blocks on the disk; one thread at a time.
class MapSaver {
 public:
  explicit MapSaver(HandOvers& hand_overs)
      : snapshots_(hand_overs.map->reader(kFilesReader)),
        reports_(hand_overs.planning->reader(kFilesReader)) {}

  /// map.pgm, map.yaml, cloud.ply, trajectory.txt and, when the map was analysed, goals.json, places.geojson
  /// and overview.png into `folder`, which is made when only it is missing; each there whole or not at all.
  /// kNotFound before the first scan.
  types::Result<SavedMap> save(const std::string& folder);

 private:
  types::Status save_analysis(const std::string& folder, const pipeline::MapSnapshot& map, SavedMap& saved);

  MapSnapshots::Reader snapshots_;
  PlanningReports::Reader reports_;
};

}  // namespace topo::daemon
