// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/view/replay/team_scene.hpp"

#include <algorithm>
#include <utility>

namespace topo::daemon {
namespace {

constexpr const char* kHeard = "heard_s_ago";

/// The one mate of that number; null when there are several, which are runs of a robot, or none.
const Json* only(const Json& mates, const Json& robot) {
  const Json* found = nullptr;
  for (const Json& mate : mates) {
    if (member_of(mate, "robot") != robot) continue;
    if (found != nullptr) return nullptr;
    found = &mate;
  }
  return found;
}

/// The age grows while nothing is heard, and what it grows to is known: so it says when the next word came.
void move_on(Json& mate, const Json& later, const Moment& moment) {
  const auto age_s = number_in(mate, kHeard), later_s = number_in(later, kHeard);
  if (age_s && later_s) mate[kHeard] = *age_s + moment.share * (*later_s - *age_s);
  const auto from = pose_in(member_of(mate, "here")), to = pose_in(member_of(later, "here"));
  if (from && to) mate["here"]["pose"] = pose_json(moment.between(*from, *to));
}

/// When the map first had a keyframe; the story's end: never.
double came_at(const Story& story, std::size_t keyframe) {
  const auto state = std::ranges::upper_bound(story.states, keyframe, {},
                                              [](const auto& s) { return keyframes_of(s.json); });
  return state == story.states.end() ? story.length_s() : state->t_s;
}

bool has_place(const Json& peers, std::uint16_t robot) {
  return std::ranges::any_of(peers, [robot](const Json& peer) {
    return member_of(peer, "robot") == robot && pose_in(member_of(peer, "here")).has_value();
  });
}

}  // namespace

Json team_at(const Story& story, double t_s) {
  const Moment moment = moment_at(story, t_s);
  if (moment.now == nullptr) return {{"present", false}};
  const Json& mates = member_of(moment.now->json, "team");
  const Json& in_team = member_of(moment.now->json, "in_team");  // older logs do not have it
  if (!in_team.is_object() && !mates.is_array()) return {{"present", false}};
  Json team = in_team.is_object() ? in_team : Json::object();
  Json peers = Json::array();
  for (Json mate : mates) {
    if (!mate.is_object()) continue;
    const Json& robot = member_of(mate, "robot");
    const bool continues = moment.next != nullptr && only(mates, robot) != nullptr;
    const Json* later = continues ? only(member_of(moment.next->json, "team"), robot) : nullptr;
    if (later != nullptr) {
      move_on(mate, *later, moment);
    } else {
      mate[kHeard] = number_in(mate, kHeard).value_or(0.0) + t_s - moment.now->t_s;
    }
    peers.push_back(std::move(mate));
  }
  team["present"] = true;
  team["peers"] = std::move(peers);
  return team;
}

Json with_last_places(Json team, const Story& story, double t_s, std::span<const LastPlace> mates) {
  for (const LastPlace& mate : mates) {
    Json& peers = team["peers"];
    if (!peers.is_array()) peers = Json::array();
    if (has_place(peers, mate.robot)) continue;
    const double age_s = std::max(0.0, t_s - came_at(story, mate.keyframe));
    const Json here{{"pose", pose_json(mate.T_map_base)}, {"claim", nullptr}, {"age_s", age_s}};
    const auto known =
        std::ranges::find_if(peers, [&](const Json& peer) { return member_of(peer, "robot") == mate.robot; });
    if (known != peers.end()) {
      (*known)["here"] = here;
    } else {
      peers.push_back(
          {{"robot", mate.robot}, {"alive", false}, {kHeard, age_s}, {"by_map", true}, {"here", here}});
    }
    team["present"] = true;
  }
  return team;
}

}  // namespace topo::daemon
