// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "daemon/control/json_rpc.hpp"

namespace topo::daemon {

/// Where a replay is, and how fast it goes. A value.
class TimeLine {
 public:
  static constexpr double kSlowest = 1.0, kFastest = 50.0;

  /// The story may have become longer; a replay that stood at its end goes on.
  void set_length(double length_s);
  /// So much of the spectator's time went by; it stops at the end.
  void advance(double seconds);
  /// {"position_s": S, "speed": 1 to 50, "playing": true}, each of them optional. kInvalidInput says what was
  /// found; nothing is changed then. A position beyond the end is the end; to play at the end begins anew.
  types::Status take(const Json& wish);

  [[nodiscard]] double position_s() const { return position_s_; }
  /// {"position_s", "length_s", "speed", "playing"}.
  [[nodiscard]] Json json() const;

 private:
  double length_s_ = 0.0, position_s_ = 0.0, speed_ = 1.0;
  bool playing_ = true;
};

}  // namespace topo::daemon
