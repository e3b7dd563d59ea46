// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include "core/slam/relation_set.hpp"
#include "core/slam/session.hpp"

namespace topo::slam {

enum class AlignmentRefusal { kNone, kNoMap, kTooFew, kTooNear, kAmbiguous, kContradicted };

/// Where a team-mate's map lies on one's own, with its evidence; `refusal` says whether that is believed.
struct Alignment {
  types::Se2 T_own_mates;
  int agreeing = 0;  ///< patches that were found where this alignment has them
  int clear = 0;     ///< of these, those whose second place is far worse
  int rival = 0;     ///< patches that stand for the next best alignment
  int against = 0;   ///< patches that would contradict the map where the alignment has them
  double spread_m = 0.0;
  std::vector<std::pair<RelationKey, Relation>> closures;  ///< one for each that agrees
  AlignmentRefusal refusal = AlignmentRefusal::kNoMap;
  [[nodiscard]] bool found() const { return refusal == AlignmentRefusal::kNone; }
};

/// A question to the loop closure thread: values and shared constants.
struct AlignmentQuery {
  Session own, mates;
  MapperParams params;
};

}  // namespace topo::slam
