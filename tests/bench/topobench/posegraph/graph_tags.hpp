// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace topo::bench {

/// What a line of a graph file is about, by its first word.
enum class GraphLine {
  kVertexG2o,
  kVertexToro,
  kEdgeG2o,
  kEdgeToro,
  kFix,
  kOther,    ///< ties or places nodes in another way: without it the graph would be another one
  kForeign,  ///< says nothing of relative poses in the plane: parameters, scans, tags
};

[[nodiscard]] GraphLine graph_line_of(std::string_view tag);

/// What a line of kind kOther is, in words: "a prior on a pose".
[[nodiscard]] std::string meaning_of(std::string_view tag);

}  // namespace topo::bench
