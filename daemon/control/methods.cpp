// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/control/methods.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

#include "daemon/app/version.hpp"

namespace topo::daemon {
namespace {

using types::Errc;

/// One method: its parameters' names, whether it needs the right to command, and its function.
struct Method {
  std::string_view name;
  bool commands;
  std::initializer_list<std::string_view> params;
  Answer (*call)(Operations&, const Json& params);
};

tl::unexpected<RpcError> refuse(const types::Error& error) {
  const RpcCode code = error.code == Errc::kInvalidInput ? RpcCode::kInvalidParams : RpcCode::kRefused;
  return tl::unexpected<RpcError>(RpcError{code, error.message});
}

Answer done(const types::Status& status) {
  if (!status) return refuse(status.error());
  return Json::object();
}

Answer call_drive(Operations& o, const Json& params) {
  const auto v_mps = real_param(params, "v_mps");
  if (!v_mps) return tl::unexpected(v_mps.error());
  const auto omega_radps = real_param(params, "omega_radps");
  if (!omega_radps) return tl::unexpected(omega_radps.error());
  return done(o.drive({*v_mps, *omega_radps}));
}

Answer call_log_level(Operations& o, const Json& params) {
  const auto level = text_param(params, "level");
  if (!level) return tl::unexpected(level.error());
  return done(o.set_log_level(*level));
}

/// With "all": true of the whole team.
Answer call_estop(Operations& o, const Json& params) {
  const auto all = switch_param(params, "all");
  if (!all) {
    o.estop();  // whatever was meant
    return tl::unexpected(all.error());
  }
  if (*all) return Json{{"order", o.estop_team()}};
  o.estop();
  return Json::object();
}

/// An order to this robot; with "robot": N to that one, with "all": true to the whole team.
template <team::OrderKind kKind>
Answer call_order(Operations& o, const Json& params) {
  const auto all = switch_param(params, "all");
  if (!all) return tl::unexpected(all.error());
  if (!*all && !params.contains("robot")) return done(carry_out(o, kKind));
  std::optional<std::uint16_t> to;
  if (params.contains("robot")) {
    const auto robot = count_param(params, "robot");
    if (!robot) return tl::unexpected(robot.error());
    if (*all || *robot > std::numeric_limits<std::uint16_t>::max())
      return tl::unexpected<RpcError>(
          RpcError{RpcCode::kInvalidParams, fmt::format("robot: found {}{}, expected the number of one robot",
                                                        *robot, *all ? " and all" : "")});
    to = static_cast<std::uint16_t>(*robot);
  }
  auto answer = o.order_team(kKind, to);
  if (!answer) return refuse(answer.error());
  return std::move(*answer);
}

/// "kind" of an area; keep out when it is absent.
tl::expected<types::AreaKind, RpcError> kind_param(const Json& params) {
  if (!params.contains("kind")) return types::AreaKind::kKeepOut;
  const auto text = text_param(params, "kind");
  if (!text) return tl::unexpected(text.error());
  if (const auto kind = types::area_kind_of(*text)) return *kind;
  return tl::unexpected<RpcError>(RpcError{
      RpcCode::kInvalidParams, fmt::format("kind: found \"{}\", expected keep_out or here_first", *text)});
}

Answer call_draw(Operations& o, const Json& params) {
  const auto points = points_param(params, "corners_m", team::kCornersMax);
  if (!points) return tl::unexpected(points.error());
  types::Polygon corners_map;
  for (const auto& [x_m, y_m] : *points) corners_map.emplace_back(x_m, y_m);
  const auto kind = kind_param(params);
  if (!kind) return tl::unexpected(kind.error());
  const auto id = o.draw_area(corners_map, *kind);
  if (!id) return refuse(id.error());
  return Json{{"id", *id}};
}

Answer call_withdraw(Operations& o, const Json& params) {
  const auto id = text_param(params, "id");
  if (!id) return tl::unexpected(id.error());
  return done(o.withdraw_area(*id));
}

const std::array<Method, 23>& methods() {
  static const std::array<Method, 23> table{{
      {"status", false, {}, [](Operations& o, const Json&) -> Answer { return o.status(); }},
      {"version",
       false,
       {},
       [](Operations&, const Json&) -> Answer {
         return Json{{"version", kVersion}};
       }},
      {"health", false, {}, [](Operations& o, const Json&) -> Answer { return o.health(); }},
      {"latency", false, {}, [](Operations& o, const Json&) -> Answer { return o.latency(); }},
      {"config", false, {}, [](Operations& o, const Json&) -> Answer { return o.config(); }},
      {"goals", false, {}, [](Operations& o, const Json&) -> Answer { return o.goals(); }},
      {"places", false, {}, [](Operations& o, const Json&) -> Answer { return o.places(); }},
      {"team", false, {}, [](Operations& o, const Json&) -> Answer { return o.team(); }},
      {"scan", false, {}, [](Operations& o, const Json&) -> Answer { return o.scan(); }},
      {"progress", false, {}, [](Operations& o, const Json&) -> Answer { return o.progress(); }},
      {"start", true, {"robot", "all"}, &call_order<team::OrderKind::kStart>},
      {"home", true, {"robot", "all"}, &call_order<team::OrderKind::kHome>},
      {"pause", true, {"robot", "all"}, &call_order<team::OrderKind::kPause>},
      {"resume", true, {"robot", "all"}, &call_order<team::OrderKind::kResume>},
      {kEstopMethod, false, {"all"}, &call_estop},
      {"drive", true, {"v_mps", "omega_radps"}, &call_drive},
      {"stop", true, {"robot", "all"}, &call_order<team::OrderKind::kStop>},
      {"session.new", true, {}, [](Operations& o, const Json&) { return done(o.begin_anew()); }},
      {"log_level", true, {"level"}, &call_log_level},
      {"map.doubt", false, {}, [](Operations& o, const Json&) -> Answer { return o.map_doubt(); }},
      {"areas", false, {}, [](Operations& o, const Json&) -> Answer { return o.areas(); }},
      {"area.draw", true, {"corners_m", "kind"}, &call_draw},
      {"area.withdraw", true, {"id"}, &call_withdraw},
  }};
  return table;
}

Answer forbidden(std::string_view method) {
  return tl::unexpected<RpcError>(RpcError{
      RpcCode::kForbidden,
      fmt::format("{} is for root, the daemon's user and the members of its group (control.group)", method)});
}

Operations::SessionDone later(const Call& call, const Methods::Late& late) {
  return [late, call](types::Result<Json> result) {
    late(call, result ? Answer(std::move(*result)) : Answer(refuse(result.error())));
  };
}

Answer call_save(Operations& o, const Call& call, const Methods::Late& late, bool& waits) {
  const auto folder = text_param(call.request.params, "dir");
  if (!folder) return tl::unexpected(folder.error());
  waits = true;
  o.save_map(*folder, later(call, late));
  return Json();
}

/// Of the map, or of a session's.
template <void (Operations::*kTiles)(std::uint64_t, Operations::SessionDone)>
Answer call_tiles(Operations& o, const Call& call, const Methods::Late& late, bool& waits) {
  const auto since = count_param(call.request.params, "since");
  if (!since) return tl::unexpected(since.error());
  waits = true;
  (o.*kTiles)(*since, later(call, late));
  return Json();
}

Answer call_trails(Operations& o, const Call& call, const Methods::Late& late, bool& waits) {
  waits = true;
  o.map_trails(later(call, late));
  return Json();
}

Answer call_goto(Operations& o, const Call& call, const Methods::Late& late, bool& waits) {
  const auto x_m = real_param(call.request.params, "x_m");
  if (!x_m) return tl::unexpected(x_m.error());
  const auto y_m = real_param(call.request.params, "y_m");
  if (!y_m) return tl::unexpected(y_m.error());
  waits = true;
  o.go_to({*x_m, *y_m}, [late, call](const types::Status& status) { late(call, done(status)); });
  return Json();
}

Answer call_sessions(Operations& o, const Call& call, const Methods::Late& late, bool& waits) {
  waits = true;
  o.list_sessions(later(call, late));
  return Json();
}

Answer call_save_session(Operations& o, const Call& call, const Methods::Late& late, bool& waits) {
  const auto name = text_param(call.request.params, "name");
  if (!name) return tl::unexpected(name.error());
  waits = true;
  o.save_session(*name, later(call, late));
  return Json();
}

/// The pose of a request; nothing when it has none.
tl::expected<std::optional<types::Se2>, RpcError> pose_param(const Json& params) {
  if (!params.contains("x_m") && !params.contains("y_m") && !params.contains("theta_rad"))
    return std::optional<types::Se2>();
  const auto x_m = real_param(params, "x_m");
  if (!x_m) return tl::unexpected(x_m.error());
  const auto y_m = real_param(params, "y_m");
  if (!y_m) return tl::unexpected(y_m.error());
  const auto theta_rad = real_param(params, "theta_rad");
  if (!theta_rad) return tl::unexpected(theta_rad.error());
  return types::Se2{*x_m, *y_m, types::wrap_angle(*theta_rad)};
}

Answer call_load_session(Operations& o, const Call& call, const Methods::Late& late, bool& waits) {
  const auto name = text_param(call.request.params, "name");
  if (!name) return tl::unexpected(name.error());
  const auto pose = pose_param(call.request.params);
  if (!pose) return tl::unexpected(pose.error());
  waits = true;
  o.load_session(*name, *pose, later(call, late));
  return Json();
}

Answer call_confirm_session(Operations& o, const Call& call, const Methods::Late& late, bool& waits) {
  const auto pose = pose_param(call.request.params);
  if (!pose) return tl::unexpected(pose.error());
  waits = true;
  o.confirm_session(*pose, later(call, late));
  return Json();
}

/// A clear never undoes a stop that came after it.
Answer call_clear_estop(Operations& o, const Call& call, const Methods::Late& late, bool& waits) {
  if (call.overtaken)
    return refuse({Errc::kBusy, "an e-stop came while this waited: it stays latched; say it again", 0});
  waits = true;
  o.clear_estop([late, call](const types::Status& status) { late(call, done(status)); });
  return Json();
}

Answer call_doctor(Operations& o, const Call& call, const Methods::Late& late, bool& waits) {
  waits = true;
  o.doctor([late, call](const Json& checks) { late(call, checks); });
  return Json();
}

/// A method that may answer after the call; it then sets `waits`.
struct LateMethod {
  std::string_view name;
  bool commands;
  std::initializer_list<std::string_view> params;
  Answer (*call)(Operations&, const Call&, const Methods::Late&, bool& waits);
};

const std::array<LateMethod, 11>& late_methods() {
  static const std::array<LateMethod, 11> table{
      {{"map.save", true, {"dir"}, &call_save},
       {"map.tiles", false, {"since"}, &call_tiles<&Operations::map_tiles>},
       {"map.trails", false, {}, &call_trails},
       {"clear_estop", true, {}, &call_clear_estop},
       {"session.list", false, {}, &call_sessions},
       {"session.save", true, {"name"}, &call_save_session},
       {"session.load", true, {"name", "x_m", "y_m", "theta_rad"}, &call_load_session},
       {"session.tiles", false, {"since"}, &call_tiles<&Operations::session_tiles>},
       {"session.confirm", true, {"x_m", "y_m", "theta_rad"}, &call_confirm_session},
       {"goto", true, {"x_m", "y_m"}, &call_goto},
       {"doctor", false, {}, &call_doctor}}};
  return table;
}

template <class Table>
const auto* find(const Table& table, std::string_view name) {
  const auto found = std::find_if(table.begin(), table.end(), [&](const auto& m) { return m.name == name; });
  return found == table.end() ? nullptr : &*found;
}

}  // namespace

types::Status carry_out(Operations& operations, team::OrderKind kind) {
  switch (kind) {
    case team::OrderKind::kEstop:
      operations.estop();
      return {};
    case team::OrderKind::kStop:
      operations.stop();
      return {};
    case team::OrderKind::kStart:
      return operations.explore();
    case team::OrderKind::kPause:
      return operations.pause();
    case team::OrderKind::kResume:
      return operations.resume();
    case team::OrderKind::kHome:
      return operations.go_home();
  }
  return types::fail(Errc::kUnsupported, "found an order of another kind, expected one of this program");
}

std::optional<Answer> Methods::answer(const Call& call) {
  const RpcRequest& request = call.request;
  if (const auto* method = find(methods(), request.method); method != nullptr) {
    if (method->commands && !call.may_command) return forbidden(method->name);
    if (const auto wrong = only_params(request.params, method->params)) return tl::unexpected(*wrong);
    return method->call(operations_, request.params);
  }
  if (const auto* method = find(late_methods(), request.method); method != nullptr) {
    if (method->commands && !call.may_command) return forbidden(method->name);
    if (const auto wrong = only_params(request.params, method->params)) return tl::unexpected(*wrong);
    bool waits = false;
    Answer answer = method->call(operations_, call, late_, waits);
    return waits ? std::nullopt : std::optional<Answer>(std::move(answer));
  }
  if (request.method == "events.subscribe") {
    if (const auto wrong = only_params(request.params, {})) return tl::unexpected(*wrong);
    // The answer is the current state; later changes are sent as events, so that no change is missed.
    subscribe_(call.client);
    return Answer(operations_.progress());
  }
  return tl::unexpected<RpcError>(RpcError{RpcCode::kMethodNotFound, "no such method"});
}

}  // namespace topo::daemon
