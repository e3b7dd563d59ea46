// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <termios.h>

#include <optional>
#include <string_view>

#include "core/types/transform.hpp"

namespace topo::daemon {

/// Standard input key by key and without echo, until destroyed.
class RawTerminal {
 public:
  RawTerminal();
  ~RawTerminal();
  RawTerminal(const RawTerminal&) = delete;
  RawTerminal& operator=(const RawTerminal&) = delete;
  /// False: standard input is no terminal, nothing was changed.
  [[nodiscard]] bool raw() const { return raw_; }

 private:
  termios before_{};
  bool raw_ = false;
};

enum class Key { kForward, kBack, kLeft, kRight, kStop, kQuit, kOther };

/// The last key in what one read gave: letters (w a s d, space, q, control-C) and the escape sequences of
/// arrow keys; nothing for no byte.
std::optional<Key> last_key(std::string_view bytes);

/// What a key asks for: a fixed share of what the robot may do; backwards at the rear's limit.
types::Twist2 twist_of(Key key, double v_max_mps, double omega_max_radps);

}  // namespace topo::daemon
