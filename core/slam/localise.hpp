// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "core/slam/refine.hpp"
#include "core/slam/search.hpp"
#include "core/slam/session.hpp"
#include "core/slam/whole_map.hpp"

namespace topo::slam {

/// When a scan is believed to be at a place of a map.
struct LocaliseParams {
  SearchWindow window{1.5, 0.6};  ///< around a given pose
  double guess_sigma_m = 0.5;     ///< of a given pose, where the scan leaves it open: along a bare corridor
  double guess_sigma_rad = 0.2;
  double response_min = 0.55;  ///< share of the points that fit; a building changes a little in a night
  double overlap_min = 0.60;
  double rival_ratio = 0.90;  ///< another place that fits this well against the best: ambiguous
  WholeSearch whole;          ///< of all places
};

enum class LocaliseRefusal { kNone, kNoMap, kTooLarge, kNothingFits, kDegenerate, kAmbiguous };

/// Where the scan fits best, with its evidence; `refusal` says whether that is believed.
struct Localisation {
  Match match;
  std::optional<Match> rival;  ///< the other place of an ambiguous scan
  LocaliseRefusal refusal = LocaliseRefusal::kNoMap;
  [[nodiscard]] bool found() const { return refusal == LocaliseRefusal::kNone; }
};

/// One sentence for a person: where, how well, or why not.
[[nodiscard]] std::string describe(const Localisation& localisation);

/// Places a scan around a given pose (the operator's, or the last one known). Pure.
[[nodiscard]] Localisation localise_near(const Session& session, const Cloud& cloud, const types::Se2& guess,
                                         const MapperParams& mapper, const LocaliseParams& params = {});

/// Places a scan anywhere in the map: branch and bound over all places where a robot can stand and all
/// directions, then refinement. Refuses when a second place fits nearly as well. Pure.
[[nodiscard]] Localisation localise_anywhere(const Session& session, const Cloud& cloud,
                                             const MapperParams& mapper, const LocaliseParams& params = {});

}  // namespace topo::slam
