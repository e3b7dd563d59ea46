// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "core/slam/alignment.hpp"
#include "core/slam/relation_set.hpp"
#include "core/slam/whole_map.hpp"

namespace topo::slam {

/// When a team-mate's map is believed to lie on one's own. Its patches (a few successive keyframes, seen as
/// one scan that looks all round) are searched in the whole map; the alignments that the places found stand
/// for must agree, and nothing else may be as good.
struct AlignmentParams {
  std::size_t patch_half = 5;  ///< keyframes on either side of a patch's middle
  std::size_t patches_max = 16;
  double response_min = 0.55;  ///< share of a patch that fits; only part of it may be in the map
  double overlap_min = 0.60;
  double contradiction_max = 0.15;  ///< share of a patch that stands where the map was seen through
  double rival_ratio = 0.90;        ///< a patch whose second place is this good says nothing by itself
  double agree_m = 0.5;             ///< two places found agree on one alignment this well, and
  double agree_rad = 0.08;          ///< so much, plus what both maps may have drifted in between
  double drift_per_m = 0.02;
  double rival_factor = 3.0;  ///< beyond so many times this an alignment is another one
  int agreeing_min = 4;       ///< patches that must stand for one alignment, of them
  int clear_min = 3;          ///< that no second place of theirs disputes
  double spread_min_m = 4.0;  ///< between the two of them that are furthest apart
  /// Most of a patch must be in the map, so that a patch that is not is soon given up.
  WholeSearch whole{.score_min = 0.55, .rivals_max = 3};
};

/// One sentence for a person.
[[nodiscard]] std::string describe(const Alignment& alignment);

/// Finds a team-mate's map in one's own without a guess. Refuses what is ambiguous: in a corridor that looks
/// the same every few metres each patch is found in several places, and several alignments are as good as one
/// another. Pure; any thread.
[[nodiscard]] Alignment align_maps(const AlignmentQuery& query, const AlignmentParams& params = {});

}  // namespace topo::slam
