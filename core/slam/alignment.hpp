// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
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

/// What an alignment must show to be accepted.
struct AlignmentGate {
  int agreeing_min = 4;         ///< patches that must support one alignment; of them
  int clear_min = 3;            ///< patches without a rival second place
  double spread_min_m = 4.0;    ///< greatest distance between two of them
  double agreeing_share = 0.5;  ///< of all patches, that must support one alignment
  double rival_share = 0.5;     ///< greatest share of that number that may support another one,
  double against_share = 0.5;   ///< and that may contradict the map where the alignment puts them
  /// A patch is nowhere else than this near to where its own map's frame puts it; infinite: the frames are
  /// unrelated.
  double off_max_m = HUGE_VAL, off_max_rad = HUGE_VAL;
};

/// A request to the loop closure thread: values and shared constants.
struct AlignmentQuery {
  Session own, mates;
  MapperParams params;
  AlignmentGate gate{};
};

}  // namespace topo::slam
