// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "drivers/pioneer/arcos_codec.hpp"
#include "drivers/pioneer/setpoints.hpp"

namespace topo::pioneer {

/// What waits for its turn on the line, because the firmware loses commands that follow each other within
/// 3 to 5 ms (PROTOCOLS section 1.2). A stop goes first; of setpoints only the newest counts.
class Outbox {
 public:
  static constexpr std::size_t kCapacity = 16;

  /// In order. False, and nothing kept, when full.
  bool push(const CommandPacket& packet);
  /// Before all that was pushed, after stop and setpoints: what was taken out and did not get through.
  void give_back(const CommandPacket& packet);
  void set_estop() { estop_ = true; }
  void set_velocity(const Setpoints& setpoints);
  void clear();

  [[nodiscard]] bool empty() const { return !estop_ && !v_mmps_ && !omega_degps_ && count_ == 0; }
  /// The next that pop() gives is E_STOP.
  [[nodiscard]] bool stop_waits() const { return estop_; }
  /// VEL 0 and RVEL 0 are among them.
  [[nodiscard]] bool standstill_waits() const { return v_mmps_ == 0 && omega_degps_ == 0; }
  /// E_STOP, then VEL, then RVEL, then what was pushed. Only when not empty.
  CommandPacket pop();

 private:
  bool estop_ = false;
  std::optional<int> v_mmps_;
  std::optional<int> omega_degps_;
  std::array<CommandPacket, kCapacity> queue_;
  std::size_t first_ = 0;
  std::size_t count_ = 0;
};

}  // namespace topo::pioneer
