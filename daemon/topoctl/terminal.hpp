// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <termios.h>

#include <optional>
#include <string_view>

#include "core/types/transform.hpp"

namespace topo::daemon {

/// Switches standard input to single keys without echo, until destroyed.
class RawTerminal {
 public:
  RawTerminal();
  ~RawTerminal();
  RawTerminal(const RawTerminal&) = delete;
  RawTerminal& operator=(const RawTerminal&) = delete;
  /// False: standard input is not a terminal, and nothing was changed.
  [[nodiscard]] bool raw() const { return raw_; }

 private:
  termios before_{};
  bool raw_ = false;
};

enum class Key { kForward, kBack, kLeft, kRight, kStop, kQuit, kOther };

/// The last key in the bytes of one read: letters (w a s d, space, q, control-C) and the escape sequences of
/// arrow keys; nothing without bytes.
std::optional<Key> last_key(std::string_view bytes);

/// The twist for a key: a fixed fraction of the robot's limits; backwards at the limit for the blind rear.
types::Twist2 twist_of(Key key, double v_max_mps, double omega_max_radps);

}  // namespace topo::daemon
