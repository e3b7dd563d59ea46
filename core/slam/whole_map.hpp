// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/slam/free_ground.hpp"
#include "core/slam/global_search.hpp"
#include "core/slam/refine.hpp"
#include "core/slam/search.hpp"
#include "core/slam/session.hpp"
#include "core/types/geometry.hpp"

namespace topo::slam {

/// A pose with its evidence: the share of points that fit minus the weighted share that contradicts the map.
struct Peak {
  Match match;
  double evidence = 0.0;
};

/// Parameters of the search of a whole map.
struct WholeSearch {
  double score_min = 0.35;  ///< minimum likelihood of a coarse peak; a lower value makes the search slower
  int rivals_max = 4;       ///< peaks in addition to the best
  double apart_m = 0.7;     ///< closer poses are one place
  double apart_rad = 0.3;
  double peak_ratio = 0.80;  ///< minimum score of a coarse peak relative to the best
  /// A point on ground that was seen to be free counts this much more against a place than a point on unknown
  /// ground.
  double contradiction_weight = 2.0;
  double margin_m = 2.0;       ///< of the window around the bounds of the map
  double thin_m = 0.05;        ///< side of a cell; one surfel per cell and side of a wall suffices
  std::size_t ray_stride = 4;  ///< every n-th ray of a keyframe marks free ground
  double width_max_m = 300.0;  ///< maximum width of a map that is searched
  SearchParams search{0.10, 0.15, 100, 6};  ///< coarse
};

/// True when two poses are different places.
[[nodiscard]] bool apart(const types::Se2& a, const types::Se2& b, const WholeSearch& search);

/// A session's surfels around a centre, thinned: a corridor driven ten times has as many as one driven once.
/// In the session's map axes. `reach_m`: RefineParams; `thin_m`: WholeSearch.
[[nodiscard]] SurfelMap thinned_map(const Session& session, const types::Vector2& centre, double half_m,
                                    double reach_m, double thin_m);

/// A session's map prepared for searches of the whole map: its surfaces, the space where a robot can stand,
/// and the ground seen to be free. Serves any number of scans; one thread at a time.
class WholeMap {
 public:
  /// Empty when there is no keyframe or the map is wider than `search` allows.
  static std::optional<WholeMap> of(const Session& session, const WholeSearch& search,
                                    const RefineParams& refine, const FreeGroundParams& ground);

  /// Poses at which the points (base_link, seen from `sensor`) fit: coarse peaks by branch and bound over all
  /// places where a robot can stand and all directions, refined, the best evidence first.
  [[nodiscard]] std::vector<Peak> peaks(std::span<const Point> points, const Point& sensor) const;

  /// The pose refined from a given one, with its evidence.
  [[nodiscard]] Peak at(std::span<const Point> points, const Point& sensor, const types::Se2& pose) const;

  /// Share of the points that, at the pose, lie on ground that was seen to be free.
  [[nodiscard]] double contradiction(std::span<const Point> points, const types::Se2& pose) const {
    return ground_.contradiction(map_, points, pose);
  }

 private:
  WholeMap(const Session& session, const types::Rectangle& box, double half_m, const WholeSearch& search,
           const RefineParams& refine, const FreeGroundParams& ground);
  WholeSearch search_;
  RefineParams refine_;
  SurfelMap map_;
  PlaceLevels levels_;
  StandingRoom room_;
  FreeGround ground_;
};

}  // namespace topo::slam
