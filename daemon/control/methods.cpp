// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/control/methods.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "daemon/app/version.hpp"

namespace topo::daemon {
namespace {

using types::Errc;

/// One method: its parameters' names, whether it needs the right to command, and what it does.
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

const std::array<Method, 10>& methods() {
  static const std::array<Method, 10> table{{
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
      {"estop", false, {}, [](Operations& o, const Json&) -> Answer { return o.estop(), Json::object(); }},
      {"clear_estop", true, {}, [](Operations& o, const Json&) { return done(o.clear_estop()); }},
      {"drive", true, {"v_mps", "omega_radps"}, &call_drive},
      {"stop", true, {}, [](Operations& o, const Json&) -> Answer { return o.stop(), Json::object(); }},
      {"log_level", true, {"level"}, &call_log_level},
  }};
  return table;
}

Answer forbidden(std::string_view method) {
  return tl::unexpected<RpcError>(RpcError{
      RpcCode::kForbidden,
      fmt::format("{} is for root, the daemon's user and the members of its group (control.group)", method)});
}

}  // namespace

std::optional<Answer> Methods::answer(const Call& call) {
  const RpcRequest& request = call.request;
  if (request.method == "map.save") {
    if (!call.may_command) return forbidden(request.method);
    if (const auto wrong = only_params(request.params, {"dir"})) return tl::unexpected(*wrong);
    const auto folder = text_param(request.params, "dir");
    if (!folder) return tl::unexpected(folder.error());
    operations_.save_map(*folder, [late = late_, call](types::Result<Json> result) {
      late(call, result ? Answer(std::move(*result)) : Answer(refuse(result.error())));
    });
    return {};
  }
  const auto found = std::find_if(methods().begin(), methods().end(),
                                  [&](const Method& m) { return m.name == request.method; });
  if (found == methods().end()) {
    return tl::unexpected<RpcError>(RpcError{RpcCode::kMethodNotFound, "no such method"});
  }
  if (found->commands && !call.may_command) return forbidden(found->name);
  if (const auto wrong = only_params(request.params, found->params)) return tl::unexpected(*wrong);
  return found->call(operations_, request.params);
}

}  // namespace topo::daemon
