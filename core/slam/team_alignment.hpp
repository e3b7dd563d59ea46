// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "core/slam/alignment.hpp"
#include "core/slam/relation_set.hpp"
#include "core/slam/whole_map.hpp"

namespace topo::slam {

/// Patches of a team-mate's map, and the acceptance of one place of a patch.
struct PatchParams {
  std::size_t half = 5;  ///< keyframes on either side of a patch's middle
  std::size_t count_max = 16;
  double cell_m = 0.08;        ///< side of a cell; a patch has one point per cell
  double response_min = 0.55;  ///< share of a patch that fits; only part of it may be in the map
  double overlap_min = 0.60;
  double contradiction_max = 0.15;  ///< share of a patch on ground that was seen to be free
  double rival_ratio = 0.90;        ///< a patch whose second place is this good is not clear
};

/// How a team-mate's map is aligned with the own one (AlignmentGate: what is accepted). Patches of that map
/// (a few successive keyframes, merged into one scan with an all-round view) are searched in the whole own
/// map; the alignments implied by the places found must agree, and no other alignment may be as good. Chosen
/// while the logs of doc/results.md, section "Mapping", were at hand.
struct AlignmentParams {
  PatchParams patch;
  double agree_m = 0.5;     ///< two places agree on one alignment within this distance, and
  double agree_rad = 0.08;  ///< this angle; the distance grows with the drift in between
  double drift_per_m = 0.02;
  double rival_factor = 3.0;  ///< beyond this multiple of the tolerances an alignment is another one
  /// Most of a patch must be in the map: the search of a patch that is not ends early.
  WholeSearch whole{.score_min = 0.55, .rivals_max = 3};
};

/// One sentence for the user.
[[nodiscard]] std::string describe(const Alignment& alignment);

/// Aligns a team-mate's map with the own one without an initial guess. Refuses ambiguous results: in a
/// corridor that looks the same every few metres each patch is found in several places, and several
/// alignments are equally good. Pure function; callable from any thread.
[[nodiscard]] Alignment align_maps(const AlignmentQuery& query, const AlignmentParams& params = {});

}  // namespace topo::slam
