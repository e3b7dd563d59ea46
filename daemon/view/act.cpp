// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/view/act.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <initializer_list>

#include "core/types/area_limits.hpp"

namespace topo::daemon {
namespace {

using types::Errc;
using types::fail;
using types::Result;

constexpr std::size_t kTokenMax = 64;  // and of an area's id

/// Whose robots an act is for: this one; this one or a mate, that "robot" names; the whole team.
enum class Whom { kThis, kOne, kAll };

/// An act of a page, and the daemon's method for it.
struct Spelling {
  std::string_view act;
  std::string_view method;
  Whom whom = Whom::kThis;
};
constexpr std::array<Spelling, 14> kCommands{{{"start", "start", Whom::kOne},
                                              {"home", "home", Whom::kOne},
                                              {"pause", "pause", Whom::kOne},
                                              {"resume", "resume", Whom::kOne},
                                              {"start_all", "start", Whom::kAll},
                                              {"home_all", "home", Whom::kAll},
                                              {"pause_all", "pause", Whom::kAll},
                                              {"resume_all", "resume", Whom::kAll},
                                              {"stop_all", "stop", Whom::kAll},
                                              {"clear_estop", "clear_estop"},
                                              {"goto", "goto"},
                                              {"set_pose", "session.confirm"},
                                              {"area_draw", "area.draw"},
                                              {"area_withdraw", "area.withdraw"}}};

Result<Act> read_reals(Act act, const Json& json, std::initializer_list<const char*> names) {
  for (const char* name : names) {
    const auto value = real_param(json, name);
    if (!value) return fail(Errc::kInvalidInput, value.error().message);
    act.params[name] = *value;
  }
  return act;
}

Result<Act> read_corners(Act act, const Json& json) {
  const auto corners = points_param(json, "corners_m", kMaxCorners);
  if (!corners) return fail(Errc::kInvalidInput, corners.error().message);
  Json& flat = act.params["corners_m"] = Json::array();
  for (const auto& [x_m, y_m] : *corners) {
    flat.push_back(x_m);
    flat.push_back(y_m);
  }
  return act;
}

Result<Act> read_drawn(Act act, const Json& json) {
  if (json.contains("kind")) {
    const auto kind = text_param(json, "kind");
    if (!kind) return fail(Errc::kInvalidInput, kind.error().message);
    if (!types::area_kind_of(*kind))
      return fail(Errc::kInvalidInput, "kind: found another word, expected keep_out or here_first");
    act.params["kind"] = *kind;
  }
  return read_corners(std::move(act), json);
}

Result<Act> read_area(Act act, const Json& json) {
  const auto id = text_param(json, "area");
  if (!id) return fail(Errc::kInvalidInput, id.error().message);
  if (id->size() > kTokenMax) {
    return fail(Errc::kInvalidInput,
                fmt::format("area: found {} characters, expected at most {}", id->size(), kTokenMax));
  }
  act.params["id"] = *id;
  return act;
}

Result<Act> read_authorise(Act act, const Json& json) {
  act.kind = Act::Kind::kAuthorise;
  const auto token = text_param(json, "token");
  if (!token) return fail(Errc::kInvalidInput, token.error().message);
  if (token->size() > kTokenMax) {
    return fail(Errc::kInvalidInput,
                fmt::format("token: found {} characters, expected at most {}", token->size(), kTokenMax));
  }
  act.token = *token;
  return act;
}

Act read_replay(Act act, const Json& json) {
  act.kind = Act::Kind::kReplay;
  for (const char* name : {"position_s", "speed", "playing"})
    if (const auto member = json.find(name); member != json.end()) act.params[name] = *member;
  return act;
}

Result<Act> read_robot(Act act, const Json& json) {
  if (!json.contains("robot")) return act;
  const auto robot = count_param(json, "robot");
  if (!robot) return fail(Errc::kInvalidInput, robot.error().message);
  act.params["robot"] = *robot;
  return act;
}

Result<Act> read_command(Act act, std::string_view name, const Json& json) {
  const auto found = std::ranges::find(kCommands, name, &Spelling::act);
  if (found == kCommands.end()) {
    return fail(
        Errc::kInvalidInput,
        "act: expected estop, authorise, replay, start, home, pause, resume, these with _all, stop_all, "
        "clear_estop, goto, set_pose, area_draw or area_withdraw");
  }
  act.method = found->method;
  if (found->whom == Whom::kOne) return read_robot(std::move(act), json);
  // Done here, it would be done to another robot than was meant.
  if (json.contains("robot"))
    return fail(Errc::kInvalidInput,
                "robot: found in an act that no single mate takes, expected start, home, "
                "pause or resume");
  if (found->whom == Whom::kAll) act.params["all"] = true;
  if (name == "goto") return read_reals(std::move(act), json, {"x_m", "y_m"});
  if (name == "set_pose") return read_reals(std::move(act), json, {"x_m", "y_m", "theta_rad"});
  if (name == "area_draw") return read_drawn(std::move(act), json);
  if (name == "area_withdraw") return read_area(std::move(act), json);
  return act;
}

/// Bounded before it is parsed: the depth is that of the brackets.
bool is_shallow(std::string_view text) {
  return std::ranges::count_if(text, [](char c) { return c == '[' || c == '{'; }) <= kMaxRequestDepth;
}

}  // namespace

Result<Act> parse_act(std::string_view text) {
  if (text.size() > kMaxActBytes || !is_shallow(text))
    return fail(Errc::kInvalidInput,
                fmt::format("found a message of {} bytes, expected a flat object of at most {}", text.size(),
                            kMaxActBytes));
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) return fail(Errc::kInvalidInput, "found no JSON object, expected {\"act\": ...}");
  const auto name = text_param(json, "act");
  if (!name) return fail(Errc::kInvalidInput, name.error().message);
  Act act;
  // An e-stop is done whatever else is wrong with it.
  const auto id = count_param(json, "id");
  if (id) act.id = *id;
  if (*name == kEstopMethod) {
    act.kind = Act::Kind::kEstop;
    act.method = kEstopMethod;
    act.params["all"] = true;
    return act;
  }
  if (!id) return fail(Errc::kInvalidInput, id.error().message);
  if (*name == "authorise") return read_authorise(std::move(act), json);
  if (*name == "replay") return read_replay(std::move(act), json);
  return read_command(std::move(act), *name, json);
}

}  // namespace topo::daemon
