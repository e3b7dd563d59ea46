// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/slam/placement.hpp"

#include <algorithm>
#include <iterator>

namespace topo::slam {
namespace {

/// The pose of the robot's own newest keyframe; empty when all are of team-mates.
std::optional<types::Se2> end_of_path(const Session& session, std::uint16_t robot) {
  const auto& all = session.keyframes;
  const auto newest = std::find_if(
      all.rbegin(), all.rend(), [robot](const KeyframePtr& keyframe) { return keyframe->id.robot == robot; });
  if (newest == all.rend()) return std::nullopt;
  return session.poses[static_cast<std::size_t>(std::distance(newest, all.rend()) - 1)];
}

/// Of the places that look alike that nearest to the end of the path: a robot that was only restarted is
/// there.
Localisation nearest_to_end(const Localisation& ambiguous, const types::Se2& end) {
  Localisation chosen = ambiguous;
  chosen.refusal = LocaliseRefusal::kNone;
  for (const Match& rival : ambiguous.rivals)
    if (distance_m(rival.T_map_base, end) < distance_m(chosen.match.T_map_base, end)) chosen.match = rival;
  return chosen;
}

/// The places that the search of the whole map names, other than the chosen one.
std::vector<Match> others_than(const Match& chosen, const Localisation& searched, const WholeSearch& search) {
  std::vector<Match> others;
  if (searched.refusal != LocaliseRefusal::kAmbiguous) return others;
  if (apart(searched.match.T_map_base, chosen.T_map_base, search)) others.push_back(searched.match);
  for (const Match& rival : searched.rivals)
    if (apart(rival.T_map_base, chosen.T_map_base, search)) others.push_back(rival);
  return others;
}

}  // namespace

PlaceDoubt doubt_about(LocaliseRefusal searched, std::size_t keyframes, const PlacementCase& known,
                       const PlacementParams& params) {
  if (known.given) return PlaceDoubt::kNone;
  if (searched == LocaliseRefusal::kAmbiguous) return PlaceDoubt::kLooksAlike;
  if (searched == LocaliseRefusal::kDegenerate) return PlaceDoubt::kAlongAWall;
  if (searched == LocaliseRefusal::kTooLarge) return PlaceDoubt::kNotSearched;
  if (known.dropped_before) return PlaceDoubt::kDroppedBefore;
  if (known.has_area_limits) return PlaceDoubt::kAreaLimits;
  if (keyframes < params.keyframes_min) return PlaceDoubt::kSmallMap;
  return PlaceDoubt::kNone;
}

Placement place_in(const Session& session, const Cloud& cloud, const PlacementCase& known,
                   const MapperParams& mapper, const PlacementParams& params) {
  Placement out;
  if (known.given) out.place = localise_near(session, cloud, *known.given, mapper, params.anywhere);
  if (known.given && !out.found()) return out;
  const Localisation searched = localise_anywhere(session, cloud, mapper, params.anywhere);
  if (!known.given) out.place = searched;
  const bool fits_somewhere =
      searched.refusal == LocaliseRefusal::kDegenerate || searched.refusal == LocaliseRefusal::kTooLarge;
  const auto end = end_of_path(session, known.robot);
  if (!known.given && searched.refusal == LocaliseRefusal::kAmbiguous)
    out.place = nearest_to_end(searched, end.value_or(searched.match.T_map_base));
  if (!known.given && fits_somewhere && end) {
    const Localisation at_end = localise_near(session, cloud, *end, mapper, params.near_end);
    if (at_end.found()) out.place = at_end;
  }
  if (!out.found()) return out;
  out.others = others_than(out.place.match, searched, params.anywhere.whole);
  out.doubt = doubt_about(searched.refusal, session.keyframes.size(), known, params);
  return out;
}

std::string_view to_text(PlaceDoubt doubt) {
  switch (doubt) {
    case PlaceDoubt::kNone:
      return "";
    case PlaceDoubt::kLooksAlike:
      return "another place looks alike";
    case PlaceDoubt::kAlongAWall:
      return "the scan leaves open where along a wall it is";
    case PlaceDoubt::kNotSearched:
      return "the map is too large to be searched as a whole for a place that looks alike";
    case PlaceDoubt::kDroppedBefore:
      return "a place in this map was dropped before";
    case PlaceDoubt::kAreaLimits:
      return "there are area limits, which a wrong place would lead through";
    case PlaceDoubt::kSmallMap:
      return "the map shows too little of the building to tell it from a place that looks alike";
  }
  return "";
}

std::string describe(const Placement& placement) {
  std::string text = describe(placement.place);
  for (const Match& other : placement.others) text += ", or at " + describe_pose(other);
  if (placement.found() && placement.doubt != PlaceDoubt::kNone)
    text.append("; a proposal, because ").append(to_text(placement.doubt));
  return text;
}

}  // namespace topo::slam
