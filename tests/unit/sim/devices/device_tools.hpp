// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/sim/devices/wire_device.hpp"

namespace topo::sim {

inline void send(WireDevice& device, const std::string& text, SimTime now) {
  device.receive({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, now);
}

/// Sends text in pieces whose sizes come from cuts (each modulo what makes sense), the rest at once.
inline void send_cut(WireDevice& device, const std::string& text, const std::vector<std::size_t>& cuts,
                     SimTime now) {
  std::size_t at = 0;
  for (const std::size_t cut : cuts) {
    const std::size_t size = std::min(cut % 32, text.size() - at);
    send(device, text.substr(at, size), now);
    at += size;
  }
  send(device, text.substr(at), now);
}

/// Everything that leaves by a moment.
inline std::string drain(WireDevice& device, SimTime until) {
  std::string out;
  while (true) {
    const auto piece = device.output().peek(until, 1000);
    if (piece.empty()) return out;
    out.append(piece);
    device.output().consume(piece.size());
  }
}

}  // namespace topo::sim
