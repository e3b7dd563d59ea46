// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/slam/relation_set.hpp"
#include "core/slam/session.hpp"

namespace topo::slam {

/// Edges between keyframes as their finders told them; those without a finder are left out.
[[nodiscard]] std::vector<FoundRelation> found_relations(std::span<const KeyframePtr> keyframes,
                                                         std::span<const Edge> edges);

}  // namespace topo::slam
