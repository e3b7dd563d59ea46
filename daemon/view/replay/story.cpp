// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/view/replay/story.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include "core/slam/session.hpp"

namespace topo::daemon {
namespace {

constexpr double kLongest_s = 1e7;          // a third of a year: no daemon's log is longer
constexpr std::int64_t kJournalLate_s = 5;  // a map's journal begins with its second keyframe
constexpr double kLongestStand_s = 2.0;     // of a robot of which nothing else is known
constexpr const char* kOfAll = "keyframes_of_all";
constexpr double kGap_s = 3.0;  // between states: what was in it is not known

/// The line's time; nothing when it is no line of a log.
std::optional<double> time_of(const Json& json) {
  const auto t_s = number_in(json, "t_s");
  const auto kind = json.find("kind");
  if (kind == json.end() || !kind->is_string() || !t_s || *t_s < 0.0 || *t_s > kLongest_s) return {};
  return *t_s;
}

std::optional<std::int64_t> written_at(const StoryLine& line) {
  const auto utc = line.json.find("utc");
  if (utc == line.json.end() || !utc->is_string()) return {};
  return seconds_of(utc->get<std::string>());
}

/// The lines from one time to another, counted from the first.
std::vector<StoryLine> between(std::vector<StoryLine> lines, double from_s, double to_s) {
  std::erase_if(lines, [&](const StoryLine& line) { return line.t_s < from_s || line.t_s > to_s; });
  for (StoryLine& line : lines) line.t_s -= from_s;
  return lines;
}

}  // namespace

std::optional<std::int64_t> seconds_of(std::string_view utc) {
  int year = 0, month = 0, day = 0, hour = 0, minute = 0, second = 0, end = 0;
  const std::string text(utc);
  const int read = std::sscanf(text.c_str(), "%4d-%2d-%2dT%2d:%2d:%2dZ%n", &year, &month, &day, &hour,
                               &minute, &second, &end);
  if (read != 6 || static_cast<std::size_t>(end) != text.size()) return {};
  const std::chrono::year_month_day date{std::chrono::year(year),
                                         std::chrono::month(static_cast<unsigned>(month)),
                                         std::chrono::day(static_cast<unsigned>(day))};
  if (!date.ok()) return {};
  const auto of_day = std::chrono::hours(hour) + std::chrono::minutes(minute) + std::chrono::seconds(second);
  return std::chrono::duration_cast<std::chrono::seconds>(std::chrono::sys_days(date).time_since_epoch() +
                                                          of_day)
      .count();
}

const Json& member_of(const Json& object, const char* name) {
  static const Json kNone;
  const auto member = object.find(name);
  return member == object.end() ? kNone : *member;
}

std::optional<double> number_in(const Json& object, const char* name) {
  const auto member = object.find(name);
  if (member == object.end() || !member->is_number()) return {};
  const auto number = member->get<double>();
  return std::isfinite(number) ? std::optional(number) : std::nullopt;
}

std::optional<types::Se2> pose_in(const Json& object) {
  const Json& pose = member_of(object, "pose");
  const auto x_m = number_in(pose, "x_m"), y_m = number_in(pose, "y_m"),
             theta_rad = number_in(pose, "theta_rad");
  if (!x_m || !y_m || !theta_rad) return {};
  return types::Se2{*x_m, *y_m, *theta_rad};
}

Json pose_json(const types::Se2& pose) {
  return {{"x_m", pose.x_m}, {"y_m", pose.y_m}, {"theta_rad", pose.theta_rad}};
}

std::size_t lines_until(const std::vector<StoryLine>& lines, double t_s) {
  return static_cast<std::size_t>(std::ranges::upper_bound(lines, t_s, {}, &StoryLine::t_s) - lines.begin());
}

Moment moment_at(const Story& story, double t_s) {
  const std::size_t until = lines_until(story.states, t_s);
  if (until == 0) return {};
  Moment moment{&story.states[until - 1]};
  if (until == story.states.size()) return moment;
  const StoryLine& next = story.states[until];
  const double apart_s = next.t_s - moment.now->t_s;
  if (apart_s > kGap_s || apart_s <= 0.0) return moment;
  moment.next = &next;
  moment.share = (t_s - moment.now->t_s) / apart_s;
  return moment;
}

std::size_t keyframes_of(const Json& state) {
  const auto map = state.find("map");
  if (map == state.end() || !map->is_object()) return 0;
  return count_param(*map, map->contains(kOfAll) ? kOfAll : "keyframes").value_or(0);
}

Story with_all_keyframes(Story story, const MapHistory& history) {
  const auto& keyframes = history.keyframes();
  if (keyframes.empty()) return story;
  const std::vector<std::size_t> own = slam::way_of(keyframes, keyframes.front()->id.robot);
  for (StoryLine& state : story.states) {
    const auto map = state.json.find("map");
    if (map == state.json.end() || !map->is_object() || map->contains(kOfAll)) continue;
    const std::size_t known = keyframes_of(state.json);
    if (known > 0) (*map)[kOfAll] = known < own.size() ? own[known] : keyframes.size();
  }
  return story;
}

Story parse_story(std::string_view text) {
  Story story;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    Json json = Json::parse(text.substr(0, end), nullptr, false);
    text.remove_prefix(std::min(end + 1, text.size()));
    const auto t_s = time_of(json);
    const std::string kind = t_s ? json["kind"].get<std::string>() : "";
    if (kind == "state") {
      story.states.push_back({*t_s, std::move(json)});
    } else if (kind == "event") {
      story.events.push_back({*t_s, std::move(json)});
    } else {
      ++story.unread;
    }
  }
  for (auto* lines : {&story.states, &story.events}) std::ranges::stable_sort(*lines, {}, &StoryLine::t_s);
  return story;
}

Story of_map(Story story, std::optional<std::int64_t> begun_s) {
  if (story.states.empty()) return story;
  std::size_t first = 0, end = story.states.size();
  for (std::size_t i = 1; i < story.states.size(); ++i) {
    if (keyframes_of(story.states[i].json) >= keyframes_of(story.states[i - 1].json)) continue;
    const auto at_s = written_at(story.states[i]);
    if (begun_s && at_s && *at_s > *begun_s + kJournalLate_s) {
      end = i;
      break;
    }
    first = i;
  }
  // What was said before the first state, by a daemon that had just started, belongs to it.
  const double from_s =
      first == 0 ? std::min(story.states[0].t_s, story.events.empty() ? kLongest_s : story.events[0].t_s)
                 : story.states[first].t_s;
  const double to_s = end == story.states.size() ? kLongest_s : story.states[end - 1].t_s;
  story.states = between(std::move(story.states), from_s, to_s);
  story.events = between(std::move(story.events), from_s, to_s);
  return story;
}

Story story_of(const MapHistory& history) {
  Story story;
  const auto& keyframes = history.keyframes();
  const std::vector<types::Se2> poses = history.poses(keyframes.size());
  double t_s = 0.0;
  const slam::Keyframe* last = nullptr;
  for (std::size_t i = 0; i < keyframes.size(); ++i) {
    const slam::Keyframe& keyframe = *keyframes[i];
    if (keyframe.id.robot != keyframes.front()->id.robot) continue;
    if (last != nullptr)
      t_s += std::clamp(types::to_seconds(keyframe.stamp - last->stamp), 0.0, kLongestStand_s);
    last = &keyframe;
    story.states.push_back({t_s,
                            {{"state", "no mission log is beside this session: map and way alone"},
                             {"pose", pose_json(poses[i])},
                             {"map", {{"keyframes", i + 1}}}}});
  }
  // What mates sent after it had made its last.
  if (!story.states.empty()) story.states.back().json["map"]["keyframes"] = keyframes.size();
  return story;
}

}  // namespace topo::daemon
