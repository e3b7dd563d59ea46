// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>

#include "daemon/app/background.hpp"
#include "daemon/app/map_doubter.hpp"
#include "daemon/control/json_rpc.hpp"

namespace topo::daemon {

/// Has the map held against itself again and again while it changes, on a background thread, and tells
/// planning where to look again. Main only.
class DoubtWatch {
 public:
  /// Of the time at most one part in so many is spent on it: with a large map it is done less often.
  static constexpr int kShare = 100;
  static constexpr types::Duration kPeriod = std::chrono::seconds(30);

  /// `files`: the thread on which `doubter` is used, and nowhere else.
  DoubtWatch(HandOvers& hand_overs, MapDoubter doubter, Background& files)
      : hand_overs_(hand_overs), doubter_(std::move(doubter)), files_(files) {}

  /// To be called every tick.
  void tick(types::Stamp now, const MappingReport& report);

  /// What was found last; of map 0 before.
  [[nodiscard]] const FoundDoubt& found() const { return found_; }
  [[nodiscard]] bool is_looking() const { return looking_; }
  /// For jobs on that thread.
  [[nodiscard]] MapDoubter& doubter() { return doubter_; }
  /// Why the map is doubted; empty when it is not.
  [[nodiscard]] std::string text() const;
  /// For status: revision, figure, why, look_again; null before the first result.
  [[nodiscard]] Json json() const;
  /// For map.doubt: doubt_json() of what was found; null before the first result.
  [[nodiscard]] Json whole_json() const { return found_.map == 0 ? Json() : doubt_json(found_); }

 private:
  void take(const types::Result<FoundDoubt>& found, types::Stamp begun);

  HandOvers& hand_overs_;
  MapDoubter doubter_;
  Background& files_;
  FoundDoubt found_;
  types::Stamp next_{};
  bool looking_ = false;
};

}  // namespace topo::daemon
