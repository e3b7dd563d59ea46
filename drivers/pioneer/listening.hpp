// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "drivers/pioneer/link.hpp"

namespace topo::pioneer {

/// An open port of a robot that did not obey: nothing is sent, because every packet feeds its watchdog
/// (PROTOCOLS section 2). An old connection goes on streaming statuses, from which it is heard whether the
/// robot stands, and when it is released: its motors are off, or its controller was reset. On a line with a
/// speed, listens at one after the other until it understands something. Never blocks.
class Listening {
 public:
  enum class Heard { kNothing, kStatus, kReleased };

  /// `first_baud`: tried first; 0: unknown.
  Listening(Link& link, int first_baud);

  Heard on_packet(const PacketView& packet);
  /// Goes to the next speed when it is due.
  types::Status on_time();
  [[nodiscard]] types::Stamp deadline() const { return deadline_; }

  /// According to the last status; false before the first.
  [[nodiscard]] bool stands() const { return stands_; }
  [[nodiscard]] bool heard() const { return heard_; }

 private:
  types::Status next_speed();

  Link& link_;
  int first_baud_;
  bool begun_ = false;
  bool heard_ = false;
  bool stands_ = false;
  std::size_t index_ = 0;
  types::Stamp deadline_{};
};

}  // namespace topo::pioneer
