// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/view/replay/team_news.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "core/team/status_message.hpp"

namespace topo::daemon {
namespace {

bool is_true(const Json& object, const char* name) { return member_of(object, name) == true; }

struct Place {
  double x_m = 0.0, y_m = 0.0;
};

/// Where a mate goes, in this robot's map.
std::optional<Place> claim_of(const Json& mate) {
  const Json& claim = member_of(member_of(mate, "here"), "claim");
  const auto x_m = number_in(claim, "x_m"), y_m = number_in(claim, "y_m");
  if (!x_m || !y_m) return {};
  return Place{*x_m, *y_m};
}

std::string duty_of(const Json& mate) {
  const Json& duty = member_of(member_of(mate, "status"), "duty");
  return duty.is_string() ? duty.get<std::string>() : "";
}

/// What was last known of a mate.
class Mate {
 public:
  void take(const Json& told, double t_s, std::vector<StoryLine>& news) {
    const auto say = [&](const char* what, Json more = Json::object()) {
      more["event"] = "mate";
      more["robot"] = told["robot"];
      more["what"] = what;
      news.push_back({t_s, std::move(more)});
    };
    const bool alive = is_true(told, "alive"), joined = is_true(told, "map_joined");
    if (alive != alive_) say(alive ? "in reach" : "out of reach");
    if (joined && !joined_) say("its map and this robot's are one");
    alive_ = alive;
    joined_ = joined;
    if (!alive) return;  // what it said before is not news
    const std::string duty = duty_of(told);
    if (!duty.empty() && duty != duty_) {
      if (duty == "able") say("is able to explore");
      if (duty == "unable") say("is not able to explore");
      if (duty == "over") say("has no mission");
      duty_ = duty;
    }
    const auto claim = claim_of(told);
    const bool other = claim && (!claim_ || std::hypot(claim->x_m - claim_->x_m, claim->y_m - claim_->y_m) >
                                                team::kSameGoal_m);
    if (other) say("goes for", {{"x_m", claim->x_m}, {"y_m", claim->y_m}});
    if (claim) claim_ = claim;
  }

 private:
  bool alive_ = false, joined_ = false;
  std::string duty_;
  std::optional<Place> claim_;
};

/// This robot's newest order to mates, as far as anybody has answered it; null: none has been.
Json answered_order(const Json& state) {
  const Json& order = member_of(member_of(state, "in_team"), "order");
  const Json &obeyed = member_of(order, "acknowledged"), &refused = member_of(order, "refused");
  if (!obeyed.is_array() || !refused.is_array() || obeyed.size() + refused.size() == 0) return nullptr;
  return {{"order", member_of(order, "number")}, {"acknowledged", obeyed}, {"refused", refused}};
}

}  // namespace

std::vector<StoryLine> team_news(const std::vector<StoryLine>& states) {
  std::vector<StoryLine> news;
  std::map<double, Mate> mates;
  Json order;
  for (const StoryLine& state : states) {
    if (const Json& team = member_of(state.json, "team"); team.is_array())
      for (const Json& told : team)
        if (const auto robot = number_in(told, "robot")) mates[*robot].take(told, state.t_s, news);
    Json answered = answered_order(state.json);
    if (answered.is_null() || answered == order) continue;
    order = answered;
    answered["event"] = "team_word";
    news.push_back({state.t_s, std::move(answered)});
  }
  return news;
}

Story with_team_news(Story story) {
  std::vector<StoryLine> news = team_news(story.states);
  std::ranges::move(news, std::back_inserter(story.events));
  std::ranges::stable_sort(story.events, {}, &StoryLine::t_s);
  return story;
}

}  // namespace topo::daemon
