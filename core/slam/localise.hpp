// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "core/slam/refine.hpp"
#include "core/slam/search.hpp"
#include "core/slam/session.hpp"
#include "core/slam/whole_map.hpp"

namespace topo::slam {

/// Acceptance criteria for the pose of a scan in a map.
struct LocaliseParams {
  SearchWindow window{1.5, 0.6};  ///< around a given pose
  double guess_sigma_m = 0.5;     ///< of a given pose, where the scan is degenerate: along a bare corridor
  double guess_sigma_rad = 0.2;
  double score_min = 0.2;      ///< minimum likelihood of a pose near the given one that is refined
  double margin_m = 2.0;       ///< of the map around the reach of the scan and the window
  double response_min = 0.55;  ///< share of the points that fit; a building may change slightly overnight
  double overlap_min = 0.60;
  /// Minimum evidence relative to the best of a rival place: ambiguous. The same for evidence per overlap, as
  /// long as the overlap suffices: a place of which the map shows less looks alike all the same.
  double rival_ratio = 0.90;
  WholeSearch whole;  ///< of the whole map
};

enum class LocaliseRefusal { kNone, kNoMap, kTooLarge, kNothingFits, kDegenerate, kAmbiguous };

/// The best pose of the scan, with its evidence; `refusal` reports whether it is accepted.
struct Localisation {
  Match match;
  std::vector<Match> rivals;  ///< the other places of an ambiguous scan, the best first
  LocaliseRefusal refusal = LocaliseRefusal::kNoMap;
  [[nodiscard]] bool found() const { return refusal == LocaliseRefusal::kNone; }
};

/// A match's pose and quality in words.
[[nodiscard]] std::string describe_pose(const Match& match);
/// One sentence for the user: the pose and its quality, or the reason of the refusal.
[[nodiscard]] std::string describe(const Localisation& localisation);

/// Localises a scan near a given pose (the operator's or the last known one). Pure function.
[[nodiscard]] Localisation localise_near(const Session& session, const Cloud& cloud, const types::Se2& guess,
                                         const MapperParams& mapper, const LocaliseParams& params = {});

/// Localises a scan anywhere in the map: branch and bound over all places where a robot can stand and all
/// directions, then refinement. Refuses when a second place fits nearly as well. Pure function.
[[nodiscard]] Localisation localise_anywhere(const Session& session, const Cloud& cloud,
                                             const MapperParams& mapper, const LocaliseParams& params = {});

}  // namespace topo::slam
