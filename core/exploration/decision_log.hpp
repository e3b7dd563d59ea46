// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/types/se2.hpp"
#include "core/types/stamp.hpp"

namespace topo::exploration {

/// A decision, readable for the operator ("topoctl goals --why").
struct Decision {
  types::Stamp stamp{};
  types::Vector2 p_map{0.0, 0.0};
  std::string text;  ///< "taken: east side of place 3, opening 1.9 m, 12.3 m to go"
};

/// The latest decisions of a mission, oldest first, and counts over the whole mission.
struct DecisionLog {
  static constexpr std::size_t kKept = 64;  ///< bounds the memory, and what an operator reads

  void note(types::Stamp now, const types::Vector2& p_map, std::string text) {
    if (decisions.size() == kKept) decisions.erase(decisions.begin());
    decisions.push_back({now, p_map, std::move(text)});
  }

  std::vector<Decision> decisions;
  std::uint64_t goals_issued = 0;
  std::uint64_t decisions_made = 0;
  std::uint64_t clusters_sum = 0;  ///< frontier clusters, over the decisions
  std::uint64_t goals_sum = 0;     ///< candidates, over the decisions
};

}  // namespace topo::exploration
