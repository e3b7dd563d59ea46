// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/slam/session.hpp"
#include "daemon/session/session_items.hpp"

namespace topo::daemon {

/// What was done to make a session of what a damaged file left.
struct Mended {
  std::uint64_t keyframes = 0;  ///< that the file once had, as far as it shows
  std::uint64_t lost = 0;       ///< of these: destroyed, or with no pose and no edge to one that has one
  std::size_t placed = 0;       ///< poses that were lost and follow from edges
  std::size_t bridged = 0;      ///< gaps across which only poses tell how the parts lie
};

/// The session of an undamaged file: keyframes whose pose is not written yet are left out, with the edges
/// that refer to them.
[[nodiscard]] slam::Session in_order(const SessionItems& items);

/// The session of a damaged file. Lost keyframes and their edges are left out, the others keep their order. A
/// keyframe whose pose is lost is placed by its edges from the nearest one that has a pose; one that no edge
/// ties to any is left out. Parts that no edge ties together any more are tied by their poses, which were
/// solved together: a weak edge across each gap, so that the graph is in one piece. `unsure`: poses that
/// were solved at different times may be together; all are solved anew.
[[nodiscard]] slam::Session mend(const SessionItems& items, bool unsure, Mended& mended);

}  // namespace topo::daemon
