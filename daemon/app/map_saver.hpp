// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <functional>
#include <mutex>
#include <string>

#include "core/types/result.hpp"
#include "daemon/threads/hand_overs.hpp"
#include "daemon/threads/thread.hpp"
#include "daemon/threads/wakeup.hpp"

namespace topo::daemon {

/// What was written.
struct SavedMap {
  std::string folder;
  std::uint64_t revision = 0;
  int width = 0;
  int height = 0;
  std::size_t points = 0;
};

/// Writes maps on a thread of its own: main answers an e-stop while a large map goes to a slow disk. Locks
/// are between main and this thread alone.
class MapSaver {
 public:
  using Outcome = types::Result<SavedMap>;
  using Done = std::function<void(Outcome)>;

  explicit MapSaver(HandOvers& hand_overs) : snapshots_(hand_overs.map->reader(kFilesReader)) {}
  MapSaver(const MapSaver&) = delete;
  MapSaver& operator=(const MapSaver&) = delete;
  ~MapSaver() { stop(); }

  types::Status start();
  /// Finishes the map being written; what waits is refused with the next collect().
  void stop();

  /// Main. map.pgm, map.yaml, cloud.ply and trajectory.txt into `folder`, which is made when only it is
  /// missing; each there whole or not at all.
  void save(const std::string& folder, Done done);
  /// Main. Readable when an outcome waits.
  [[nodiscard]] int fd() const { return outcome_ready_.fd(); }
  /// Main. Calls the `done` of what was finished.
  void collect();

 private:
  struct Job {
    std::string folder;
    Done done;
    Outcome outcome;
  };
  void run();
  Outcome write(const std::string& folder);

  MapSnapshots::Reader snapshots_;
  Wakeup job_ready_, outcome_ready_;
  std::mutex mutex_;
  std::deque<Job> waiting_, finished_;  ///< guarded by mutex_
  bool stopping_ = false;               ///< guarded by mutex_
  Thread thread_;
};

}  // namespace topo::daemon
