// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "core/types/se2.hpp"

namespace topo::exploration {

/// An order of the operator.
enum class Order : std::uint8_t { kStand, kExplore, kHome, kGoTo };

struct Mission {
  std::uint64_t number = 0;  ///< a new number means a new mission
  Order order = Order::kStand;
  bool paused = false;
  types::Vector2 target{0.0, 0.0};  ///< kGoTo, in map
};

}  // namespace topo::exploration
