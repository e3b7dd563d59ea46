// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/slam/team_alignment.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <unordered_set>

#include "core/slam/information.hpp"

namespace topo::slam {
namespace {

/// Several successive keyframes of a team-mate merged into one scan, in the axes of the middle one.
struct Patch {
  std::size_t middle = 0;  ///< index in the team-mate's session
  types::Se2 pose;         ///< of the middle keyframe, in the team-mate's map
  Point sensor = Point::Zero();
  std::vector<Point> points;
  std::vector<Peak> peaks;  ///< places found, best first
  bool clear = false;       ///< the best place has no rival
};

/// A place found for a patch and the alignment that it implies.
struct Hypothesis {
  std::size_t patch = 0, peak = 0;
  types::Se2 T_own_mates;
};

std::uint64_t cell_of(const Point& p, double cell_m) {
  const auto part = [cell_m](float v) {
    return static_cast<std::uint32_t>(static_cast<std::int32_t>(std::floor(static_cast<double>(v) / cell_m)));
  };
  return static_cast<std::uint64_t>(part(p.x())) << 32U | part(p.y());
}

Patch make_patch(const Session& mates, std::size_t first, std::size_t last, double cell_m) {
  Patch patch;
  patch.middle = first + (last - first) / 2;
  patch.pose = mates.poses[patch.middle];
  patch.sensor = mates.keyframes[patch.middle]->sensor;
  std::unordered_set<std::uint64_t> seen;
  for (std::size_t i = first; i <= last; ++i) {
    const types::Se2 T_middle_i = patch.pose.inverse() * mates.poses[i];
    for (const Point& point : mates.keyframes[i]->content.match_points()) {
      const Point p = (T_middle_i * types::Vector2(point.cast<double>())).cast<float>();
      if (seen.insert(cell_of(p, cell_m)).second) patch.points.push_back(p);
    }
  }
  return patch;
}

/// Patches distributed evenly over the session; none spans two origins.
std::vector<Patch> make_patches(const Session& mates, const AlignmentParams& params) {
  std::vector<std::pair<std::size_t, std::size_t>> runs;
  const std::size_t length = 2 * params.patch.half + 1;
  for (std::size_t first = 0; first + length <= mates.keyframes.size(); first += length) {
    const std::size_t last = first + length - 1;
    if (mates.keyframes[first]->id.origin() == mates.keyframes[last]->id.origin())
      runs.emplace_back(first, last);
  }
  std::vector<Patch> patches;
  const std::size_t count = std::min(runs.size(), params.patch.count_max);
  for (std::size_t k = 0; k < count; ++k) {
    const auto& [first, last] = runs[k * runs.size() / count];
    patches.push_back(make_patch(mates, first, last, params.patch.cell_m));
  }
  return patches;
}

/// Stores the places that are nearly as good as the best and pass the acceptance criteria.
void find(Patch& patch, const WholeMap& map, const AlignmentGate& gate, const AlignmentParams& params) {
  std::vector<Peak> peaks = map.peaks(patch.points, patch.sensor);
  std::erase_if(peaks, [&](const Peak& peak) {
    return types::is_apart(patch.pose, peak.match.T_map_base, gate.off_max_m, gate.off_max_rad);
  });
  const double best = peaks.empty() ? 0.0 : peaks.front().evidence;
  const auto rivals = std::count_if(peaks.begin(), peaks.end(), [&](const Peak& peak) {
    return apart(peak.match.T_map_base, peaks.front().match.T_map_base, params.whole) &&
           peak.evidence >= params.patch.rival_ratio * best;
  });
  std::erase_if(peaks, [&](const Peak& peak) {
    return peak.evidence < params.patch.rival_ratio * best || peak.match.degenerate ||
           peak.match.overlap < params.patch.overlap_min || peak.match.response < params.patch.response_min ||
           map.contradiction(patch.points, peak.match.T_map_base) > params.patch.contradiction_max;
  });
  patch.clear = rivals == 0 && !peaks.empty() && peaks.front().evidence >= best;
  patch.peaks = std::move(peaks);
}

class Vote {
 public:
  Vote(const std::vector<Patch>& patches, const AlignmentParams& params)
      : patches_(patches), params_(params) {
    for (std::size_t i = 0; i < patches.size(); ++i) {
      for (std::size_t k = 0; k < patches[i].peaks.size(); ++k)
        hypotheses_.push_back({i, k, patches[i].peaks[k].match.T_map_base * patches[i].pose.inverse()});
    }
  }

  /// The alignment supported by most patches, and of equals the one with the best evidence.
  [[nodiscard]] std::vector<Hypothesis> best(const Hypothesis* apart_from = nullptr) const {
    std::vector<Hypothesis> best;
    double best_evidence = 0.0;
    for (const Hypothesis& one : hypotheses_) {
      if (apart_from != nullptr && agree(*apart_from, one, params_.rival_factor)) continue;
      std::vector<Hypothesis> agreeing = agreeing_with(one);
      double evidence = 0.0;
      for (const Hypothesis& other : agreeing) evidence += evidence_of(other);
      if (agreeing.size() < best.size() || (agreeing.size() == best.size() && evidence <= best_evidence))
        continue;
      best = std::move(agreeing);
      best_evidence = evidence;
    }
    return best;
  }

 private:
  [[nodiscard]] double evidence_of(const Hypothesis& h) const {
    return patches_[h.patch].peaks[h.peak].evidence;
  }

  /// The places that agree with the hypothesis, at most one per patch; the hypothesis itself is first.
  [[nodiscard]] std::vector<Hypothesis> agreeing_with(const Hypothesis& one) const {
    std::vector<Hypothesis> agreeing{one};
    for (const Hypothesis& other : hypotheses_) {
      const bool counted = std::any_of(agreeing.begin(), agreeing.end(),
                                       [&](const Hypothesis& h) { return h.patch == other.patch; });
      if (!counted && agree(one, other)) agreeing.push_back(other);
    }
    return agreeing;
  }

  /// True when the place of the other's patch, as predicted by the one, agrees with the place found.
  [[nodiscard]] bool agree(const Hypothesis& one, const Hypothesis& other, double factor = 1.0) const {
    const types::Se2& pose = patches_[other.patch].pose;
    const types::Se2 off = (one.T_own_mates * pose).inverse() * (other.T_own_mates * pose);
    const double drift =
        params_.drift_per_m * (patches_[one.patch].pose.translation() - pose.translation()).norm();
    return off.translation().norm() <= factor * (params_.agree_m + drift) &&
           std::abs(types::wrap_angle(off.theta_rad)) <= factor * params_.agree_rad;
  }

  const std::vector<Patch>& patches_;
  const AlignmentParams& params_;
  std::vector<Hypothesis> hypotheses_;
};

double spread_of(const std::vector<Hypothesis>& agreeing, const std::vector<Patch>& patches) {
  double spread_m = 0.0;
  for (const Hypothesis& a : agreeing) {
    for (const Hypothesis& b : agreeing) {
      spread_m = std::max(spread_m,
                          (patches[a.patch].pose.translation() - patches[b.patch].pose.translation()).norm());
    }
  }
  return spread_m;
}

/// Number of patches without agreement that contradict the map at the predicted place, after refinement
/// there.
int count_against(const std::vector<Patch>& patches, const std::vector<Hypothesis>& agreeing,
                  const WholeMap& map, const AlignmentParams& params) {
  int against = 0;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    const bool agrees =
        std::any_of(agreeing.begin(), agreeing.end(), [&](const Hypothesis& h) { return h.patch == i; });
    if (agrees) continue;
    const Patch& patch = patches[i];
    const Peak there = map.at(patch.points, patch.sensor, agreeing.front().T_own_mates * patch.pose);
    against +=
        map.contradiction(patch.points, there.match.T_map_base) > params.patch.contradiction_max ? 1 : 0;
  }
  return against;
}

/// The closure from the own keyframe nearest to the place where the patch was found.
std::pair<RelationKey, Relation> closure_of(const Hypothesis& found, const Patch& patch,
                                            const AlignmentQuery& query) {
  const Session& own = query.own;
  const Match& match = patch.peaks[found.peak].match;
  const types::Se2& found_at = match.T_map_base;
  const auto nearest =
      std::min_element(own.poses.begin(), own.poses.end(), [&](const types::Se2& a, const types::Se2& b) {
        return distance_m(a, found_at) < distance_m(b, found_at);
      });
  const GraphParams& graph = query.params.graph;
  Relation relation;
  relation.T_from_to = nearest->inverse() * match.T_map_base;
  relation.information = edge_information(match.scan_information, match.T_map_base.theta_rad,
                                          graph.loop_trans_floor_m, graph.loop_rot_floor_rad);
  relation.robust = true;
  const KeyframeId& from = own.keyframes[static_cast<std::size_t>(nearest - own.poses.begin())]->id;
  return {{from, query.mates.keyframes[patch.middle]->id}, relation};
}

/// A share of the team-mate's patches must support the alignment: in a building with similar rooms a handful
/// of patches agree on a wrong one, and a wrong join is never undone.
AlignmentRefusal judge(const Alignment& alignment, std::size_t patches, const AlignmentGate& gate) {
  if (alignment.agreeing < gate.agreeing_min || alignment.clear < gate.clear_min ||
      alignment.agreeing < gate.agreeing_share * static_cast<double>(patches))
    return AlignmentRefusal::kTooFew;
  if (alignment.rival > gate.rival_share * alignment.agreeing) return AlignmentRefusal::kAmbiguous;
  if (alignment.spread_m < gate.spread_min_m) return AlignmentRefusal::kTooNear;
  if (alignment.against > gate.against_share * alignment.agreeing) return AlignmentRefusal::kContradicted;
  return AlignmentRefusal::kNone;
}

}  // namespace

Alignment align_maps(const AlignmentQuery& query, const AlignmentParams& params) {
  Alignment out;
  if (query.mates.keyframes.empty()) return out;
  const auto map = WholeMap::of(query.own, params.whole, query.params.refine, query.params.free_ground);
  if (!map) return out;
  std::vector<Patch> patches = make_patches(query.mates, params);
  for (Patch& patch : patches) find(patch, *map, query.gate, params);
  out.refusal = AlignmentRefusal::kTooFew;
  const Vote vote(patches, params);
  const std::vector<Hypothesis> agreeing = vote.best();
  if (agreeing.empty()) return out;
  out.T_own_mates = agreeing.front().T_own_mates;
  out.agreeing = static_cast<int>(agreeing.size());
  out.clear = static_cast<int>(std::count_if(agreeing.begin(), agreeing.end(), [&](const Hypothesis& h) {
    return h.peak == 0 && patches[h.patch].clear;
  }));
  out.rival = static_cast<int>(vote.best(&agreeing.front()).size());
  out.spread_m = spread_of(agreeing, patches);
  out.against = count_against(patches, agreeing, *map, params);
  out.refusal = judge(out, patches.size(), query.gate);
  for (const Hypothesis& found : agreeing)
    out.closures.push_back(closure_of(found, patches[found.patch], query));
  return out;
}

std::string describe(const Alignment& alignment) {
  std::array<char, 160> text{};
  const types::Se2& T = alignment.T_own_mates;
  std::snprintf(text.data(), text.size(),
                "x %.2f y %.2f theta %.2f: %d places agree over %.0f m (%d clear), %d on another, %d against",
                T.x_m, T.y_m, T.theta_rad, alignment.agreeing, alignment.spread_m, alignment.clear,
                alignment.rival, alignment.against);
  const std::string evidence(text.data());
  switch (alignment.refusal) {
    case AlignmentRefusal::kNone:
      return "joined at " + evidence;
    case AlignmentRefusal::kNoMap:
      return "there is no map, or it is too large to be searched as a whole";
    case AlignmentRefusal::kTooFew:
      return "too little of the team-mate's map was found; best at " + evidence;
    case AlignmentRefusal::kTooNear:
      return "what was found is one place; best at " + evidence;
    case AlignmentRefusal::kAmbiguous:
      return "two alignments are alike; best at " + evidence;
    case AlignmentRefusal::kContradicted:
      return "the maps contradict each other; best at " + evidence;
  }
  return {};
}

}  // namespace topo::slam
