// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <map>
#include <span>
#include <vector>

#include "core/slam/keyframe.hpp"

// Items that each origin numbers from 0 on, stored in a std::map by KeyframeId: how a robot describes which
// items it has, so that another sends the rest.
namespace topo::slam {

/// A robot has all items of an origin below `next`, and possibly some above.
struct OriginCount {
  std::uint16_t robot = 0;
  std::uint32_t next = 0;
  std::uint32_t run = 0;
  friend auto operator<=>(const OriginCount&, const OriginCount&) = default;
};

/// The gap-free counts of the items, by origin.
template <class Value>
std::vector<OriginCount> counts_of(const std::map<KeyframeId, Value>& things) {
  std::vector<OriginCount> counts;
  for (const auto& [id, thing] : things) {
    if (counts.empty() || Origin{counts.back().robot, counts.back().run} != id.origin())
      counts.push_back({id.robot, 0, id.run});
    if (id.sequence == counts.back().next) ++counts.back().next;
  }
  return counts;
}

/// Items held here that, by its counts, the other robot lacks; at most `count_max`, origin by origin, oldest
/// first.
template <class Value>
std::vector<Value> missing_of(const std::map<KeyframeId, Value>& things, std::span<const OriginCount> there,
                              std::size_t count_max) {
  std::vector<Value> missing;
  auto at = things.begin();
  while (at != things.end() && missing.size() < count_max) {
    const Origin origin = at->first.origin();
    const auto known = std::find_if(there.begin(), there.end(), [&](const OriginCount& count) {
      return Origin{count.robot, count.run} == origin;
    });
    if (known != there.end()) at = things.lower_bound({origin.robot, known->next, origin.run});
    for (; at != things.end() && at->first.origin() == origin && missing.size() < count_max; ++at)
      missing.push_back(at->second);
  }
  return missing;
}

}  // namespace topo::slam
