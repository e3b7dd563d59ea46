// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/slam/keyframe.hpp"
#include "core/slam/pose_graph.hpp"
#include "core/slam/search.hpp"

namespace topo::slam {

/// One run of keyframes of another visit, with their poses at the time of the request.
struct LoopGroup {
  std::vector<KeyframePtr> keyframes;
  std::vector<types::Se2> poses;
  std::size_t reference = 0;  ///< node that a closure is attached to
  types::Se2 reference_pose;
  SearchWindow window;  ///< bound on the drift between the visits
};

/// A request to the loop closure thread. Values and shared constants, immutable once created.
struct LoopQuery {
  std::size_t node = 0;
  KeyframePtr keyframe;
  types::Se2 pose;
  std::vector<LoopGroup> groups;
  MapperParams params;
};

/// Why a candidate was rejected.
enum class LoopRejection { kNone, kNoMatch, kLowResponse, kLowOverlap, kAmbiguous, kDegenerate };

/// One candidate with its evidence; `rejection` is the gate's decision.
struct LoopCandidate {
  Edge edge;
  double response = 0.0;
  double overlap = 0.0;
  double second_peak = 0.0;  ///< relative to the best; 0 when the search was too narrow to have one
  LoopRejection rejection = LoopRejection::kNoMatch;
};

struct LoopAnswer {
  std::size_t node = 0;
  std::vector<LoopCandidate> candidates;
};

/// Outcome of an answer.
struct LoopVerdict {
  int accepted = 0;
  int rejected = 0;
};

/// Matches the keyframe against every group. Pure function; callable from any thread.
LoopAnswer find_closures(const LoopQuery& query);

}  // namespace topo::slam
