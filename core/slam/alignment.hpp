// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include "core/slam/relation_set.hpp"
#include "core/slam/session.hpp"

namespace topo::slam {

enum class AlignmentRefusal { kNone, kNoMap, kTooFew, kTooNear, kAmbiguous, kContradicted };

/// The pose of a team-mate's map in the own one, with its evidence; `refusal` reports whether it is accepted.
struct Alignment {
  types::Se2 T_own_mates;
  int agreeing = 0;  ///< patches found where this alignment predicts them
  int clear = 0;     ///< of these, those whose second place is far worse
  int rival = 0;     ///< patches that support the next best alignment
  int against = 0;   ///< patches that contradict the map at the predicted place
  double spread_m = 0.0;
  std::vector<std::pair<RelationKey, Relation>> closures;  ///< one for each agreeing patch
  AlignmentRefusal refusal = AlignmentRefusal::kNoMap;
  [[nodiscard]] bool found() const { return refusal == AlignmentRefusal::kNone; }
};

/// A request to the loop closure thread: values and shared constants.
struct AlignmentQuery {
  Session own, mates;
  MapperParams params;
};

}  // namespace topo::slam
