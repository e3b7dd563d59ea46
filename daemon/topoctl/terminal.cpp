// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/topoctl/terminal.hpp"

#include <unistd.h>

namespace topo::daemon {
namespace {

constexpr double kBack_mps = 0.1;  // the rear is blind
constexpr char kEscape = '\x1b';
constexpr char kControlC = '\x03';
constexpr char kControlD = '\x04';

Key letter(char c) {
  switch (c) {
    case 'w':
    case 'W':
      return Key::kForward;
    case 's':
    case 'S':
      return Key::kBack;
    case 'a':
    case 'A':
      return Key::kLeft;
    case 'd':
    case 'D':
      return Key::kRight;
    case ' ':
      return Key::kStop;
    case 'q':
    case 'Q':
    case kControlC:
    case kControlD:
      return Key::kQuit;
    default:
      return Key::kOther;
  }
}

Key arrow(char c) {
  switch (c) {
    case 'A':
      return Key::kForward;
    case 'B':
      return Key::kBack;
    case 'C':
      return Key::kRight;
    case 'D':
      return Key::kLeft;
    default:
      return Key::kOther;
  }
}

}  // namespace

RawTerminal::RawTerminal() {
  if (::tcgetattr(STDIN_FILENO, &before_) != 0) return;
  termios settings = before_;
  settings.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
  settings.c_cc[VMIN] = 0;
  settings.c_cc[VTIME] = 0;
  raw_ = ::tcsetattr(STDIN_FILENO, TCSANOW, &settings) == 0;
}

RawTerminal::~RawTerminal() {
  if (raw_) ::tcsetattr(STDIN_FILENO, TCSANOW, &before_);
}

std::optional<Key> last_key(std::string_view bytes) {
  std::optional<Key> key;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    if (bytes[i] != kEscape) {
      key = letter(bytes[i]);
    } else if (i + 2 < bytes.size() && (bytes[i + 1] == '[' || bytes[i + 1] == 'O')) {
      key = arrow(bytes[i + 2]);
      i += 2;
    } else {
      key = Key::kOther;
    }
    if (key == Key::kQuit) return key;  // input after it is ignored
  }
  return key;
}

types::Twist2 twist_of(Key key, double v_max_mps, double omega_max_radps) {
  constexpr double kShare = 0.5;
  switch (key) {
    case Key::kForward:
      return {kShare * v_max_mps, 0.0};
    case Key::kBack:
      return {-kBack_mps, 0.0};
    case Key::kLeft:
      return {0.0, kShare * omega_max_radps};
    case Key::kRight:
      return {0.0, -kShare * omega_max_radps};
    default:
      return {};
  }
}

}  // namespace topo::daemon
