// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "core/travel/params.hpp"
#include "core/types/map_correction.hpp"
#include "core/types/se2.hpp"
#include "core/types/stamp.hpp"

namespace topo::travel {

/// Obstacles that no keyframe contains, in map: detected only by sonar or a bumper, places where the robot
/// got stuck, and passages in which it cannot turn. A value.
class ObstacleMemory {
 public:
  explicit ObstacleMemory(const ObstacleMemoryParams& params = {}) : params_(params) {}

  /// A sonar echo where no laser detects anything. When there are too many, the entry that was noted least
  /// often is replaced, and of several the oldest: a touch is never dropped for an echo.
  void note_echo(const types::Vector2& p_map, types::Stamp now) { note(p_map, 1, now); }
  /// A bumper contact or a stalled wheel. It cannot be a reflection, so it counts at once.
  void note_touch(const types::Vector2& p_map, types::Stamp now) { note(p_map, params_.echo_times, now); }
  /// The robot got stuck here.
  void block(const types::Vector2& p_map, types::Stamp now);
  /// A passage in which the robot gets stuck. It stays closed until open_passages().
  void close_passage(const types::Vector2& p_map) { too_tight_.push_back(p_map); }
  void open_passages() { too_tight_.clear(); }

  /// The map was corrected.
  void move(const types::MapCorrection& correction);
  /// Drops expired entries.
  void expire(types::Stamp now);
  /// Drops echoes, touches and blocked places. False when there are none, or when the last call that dropped
  /// any was less than `forget_again` ago.
  bool forget(types::Stamp now);

  /// Echoes that were noted often enough.
  [[nodiscard]] std::vector<types::Vector2> echoed() const;
  /// Closed passages, and points around the places where the robot got stuck.
  [[nodiscard]] std::vector<types::Vector2> stuck_on() const;

 private:
  struct Entry {
    types::Vector2 p_map{0.0, 0.0};
    types::Stamp until{};
    int times = 1;
  };
  void note(const types::Vector2& p_map, int times, types::Stamp now);

  ObstacleMemoryParams params_;
  std::vector<Entry> blocked_, echoes_;
  std::vector<types::Vector2> too_tight_;
  types::Stamp forgotten_{};
};

}  // namespace topo::travel
