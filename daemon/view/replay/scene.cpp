// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/view/replay/scene.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace topo::daemon {
namespace {

constexpr std::size_t kEvents = 60, kSamples = 300;

void move_on(Json& status, const Moment& moment) {
  if (moment.next == nullptr) return;
  const auto from = pose_in(moment.now->json), to = pose_in(moment.next->json);
  if (from && to) status["pose"] = pose_json(moment.between(*from, *to));
}

bool is_event(const Json& line, std::string_view name) {
  const auto event = line.find("event");
  return event != line.end() && event->is_string() && *event == name;
}

}  // namespace

Json status_at(const Story& story, double t_s, const std::string& robot) {
  const Moment moment = moment_at(story, t_s);
  const StoryLine* now = moment.now;
  Json status = now == nullptr ? Json{{"state", "not begun yet"}} : now->json;
  for (const char* other : {"kind", "t_s", "utc", "team", "in_team"}) status.erase(other);
  status["robot"] = robot;
  if (now == nullptr) return status;
  move_on(status, moment);
  Json doubts = Json::array();
  if (const auto names = status.find("doubts"); names != status.end() && names->is_array())
    for (const Json& name : *names) doubts.push_back({{"found", name}, {"cure", ""}});
  status.erase("doubts");
  status["plausibility"] = {{"doubts", std::move(doubts)}};
  return status;
}

Json goals_at(const Story& story, double t_s) {
  const StoryLine* now = moment_at(story, t_s).now;
  Json goals{{"goal", nullptr}, {"decisions", Json::array()}};
  if (now == nullptr) return goals;
  if (const auto goal = now->json.find("goal"); goal != now->json.end()) goals["goal"] = *goal;
  const auto end = story.events.rend();
  const auto from = std::make_reverse_iterator(story.events.begin() +
                                               static_cast<std::ptrdiff_t>(lines_until(story.events, t_s)));
  const auto decision =
      std::find_if(from, end, [](const auto& line) { return is_event(line.json, "decision"); });
  if (decision != end) goals["decisions"].push_back(decision->json);
  return goals;
}

Json areas_at(const Story& story, double t_s) {
  const std::size_t until = lines_until(story.events, t_s);
  for (std::size_t i = until; i-- > 0;) {
    const Json& line = story.events[i].json;
    const auto areas = line.find("areas");
    if (is_event(line, "area") && areas != line.end() && areas->is_array())
      return {{"areas", *areas}, {"trouble", ""}};
  }
  return {{"areas", Json::array()}, {"trouble", ""}};
}

Json past_at(const Story& story, double t_s) {
  Json events = Json::array(), known = Json::array();
  const std::size_t said = lines_until(story.events, t_s);
  for (std::size_t i = said - std::min(said, kEvents); i < said; ++i) {
    Json event = story.events[i].json;
    event["t_s"] = story.events[i].t_s;
    for (const char* other : {"kind", "areas", "corners_m"}) event.erase(other);
    events.push_back(std::move(event));
  }
  const std::size_t step = story.states.size() / kSamples + 1, states = lines_until(story.states, t_s);
  for (std::size_t i = 0; i < states; i += step) {
    const auto m2 = number_in(story.states[i].json, "known_m2");
    if (m2) known.push_back(Json::array({story.states[i].t_s, *m2}));
  }
  return {{"events", std::move(events)}, {"known_m2", std::move(known)}};
}

std::size_t keyframes_at(const Story& story, double t_s) {
  const StoryLine* now = moment_at(story, t_s).now;
  return now == nullptr ? 0 : keyframes_of(now->json);
}

}  // namespace topo::daemon
