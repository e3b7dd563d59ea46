// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/topoctl/setup_screen.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "daemon/setup/scan_picture.hpp"

namespace topo::daemon {
namespace {

constexpr types::Duration kRedraw = std::chrono::milliseconds(250);

std::string pictures_of(const SetupState& state, std::span<const LiveScanner> scanners) {
  std::vector<std::string> titles;
  std::vector<std::vector<std::string>> pictures;
  for (std::size_t i = 0; i < scanners.size(); ++i) {
    titles.push_back(
        fmt::format("{} {}", state.found.scanners[i].product, state.found.scanners[i].serial_number));
    pictures.push_back(scan_picture(scanners[i].latest()));
  }
  return side_by_side(titles, pictures);
}

/// Each line to its end, so that nothing of the picture before is left.
std::string over_the_last(const std::string& text, std::size_t lines) {
  std::string out = fmt::format("\0337\033[{}A\r", lines);
  for (const char c : text) out.append(c == '\n' ? "\033[K\n" : std::string(1, c));
  return out + "\0338";
}

}  // namespace

void SetupScreen::ask(const SetupState& state, std::span<const LiveScanner> scanners) {
  const Question asked = question(state);
  if (!state.remark.empty()) fmt::print("{}\n", state.remark);
  fmt::print("\n{}", asked.text);
  if (asked.looks) {
    const std::string pictures = pictures_of(state, scanners);
    lines_ = static_cast<std::size_t>(std::count(pictures.begin(), pictures.end(), '\n'));
    fmt::print("\n{}", pictures);
  }
  fmt::print(" [{}] ", asked.otherwise);
  std::fflush(stdout);
}

void SetupScreen::refresh(const SetupState& state, std::span<const LiveScanner> scanners, types::Stamp now) {
  if (!terminal_ || lines_ == 0 || now - drawn_ < kRedraw) return;
  drawn_ = now;
  fmt::print("{}", over_the_last(pictures_of(state, scanners), lines_));
  std::fflush(stdout);
}

}  // namespace topo::daemon
