// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "drivers/pioneer/arcos_codec.hpp"
#include "drivers/pioneer/setpoints.hpp"

namespace topo::pioneer {

/// Commands that wait for the line, because the firmware loses commands that follow each other within 3 to 5
/// ms (PROTOCOLS section 1.2). A stop has priority; of setpoints only the newest is kept.
class Outbox {
 public:
  static constexpr std::size_t kCapacity = 16;

  /// Appends a command. False, without effect, when full.
  bool push(const CommandPacket& packet);
  /// Puts a command that was taken out but not delivered before all pushed commands, after stop and
  /// setpoints.
  void give_back(const CommandPacket& packet);
  void set_estop() { estop_ = true; }
  void set_velocity(const Setpoints& setpoints);
  void clear();

  [[nodiscard]] bool empty() const { return !estop_ && !v_mmps_ && !omega_degps_ && count_ == 0; }
  /// True when the next pop() returns E_STOP.
  [[nodiscard]] bool stop_waits() const { return estop_; }
  /// True when VEL 0 and RVEL 0 wait.
  [[nodiscard]] bool standstill_waits() const { return v_mmps_ == 0 && omega_degps_ == 0; }
  /// Returns E_STOP, then VEL, then RVEL, then pushed commands. Requires a non-empty outbox.
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
