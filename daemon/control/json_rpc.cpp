// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/control/json_rpc.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace topo::daemon {
namespace {

using types::Errc;
using types::fail;
using types::Result;

tl::unexpected<RpcError> refuse(RpcCode code, std::string message) {
  return tl::unexpected<RpcError>(RpcError{code, std::move(message)});
}

/// Maximum nesting of brackets outside strings, computed before the parser builds the nested values.
int bracket_depth(std::string_view text) {
  int depth = 0, deepest = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string) {
      if (c == '\\') {
        ++i;
      } else if (c == '"') {
        in_string = false;
      }
    } else if (c == '"') {
      in_string = true;
    } else if (c == '[' || c == '{') {
      deepest = std::max(deepest, ++depth);
    } else if (c == ']' || c == '}') {
      --depth;
    }
  }
  return deepest;
}

std::string dump(const Json& json) { return result_text(json) + "\n"; }

std::string short_dump(const Json& json) {
  const std::string text = json.dump(-1, ' ', true, Json::error_handler_t::replace);
  return text.size() <= 60 ? text : text.substr(0, 60) + "...";
}

Errc to_errc(int code) {
  switch (static_cast<RpcCode>(code)) {
    case RpcCode::kForbidden:
      return Errc::kPermission;
    case RpcCode::kInvalidParams:
      return Errc::kInvalidInput;
    case RpcCode::kRefused:
    case RpcCode::kMethodNotFound:
      return Errc::kUnsupported;
    default:
      return Errc::kProtocol;
  }
}

}  // namespace

tl::expected<RpcRequest, RpcError> parse_request(std::string_view line) {
  if (line.size() > kMaxRequestBytes) {
    return refuse(RpcCode::kInvalidRequest, fmt::format("request of more than {} bytes", kMaxRequestBytes));
  }
  if (bracket_depth(line) > kMaxRequestDepth) {
    return refuse(RpcCode::kInvalidRequest, fmt::format("nested deeper than {}", kMaxRequestDepth));
  }
  Json json = Json::parse(line, nullptr, false);
  if (json.is_discarded()) return refuse(RpcCode::kParseError, "no valid JSON");
  if (!json.is_object()) return refuse(RpcCode::kInvalidRequest, "expected one object a line");
  const auto version = json.find("jsonrpc");
  if (version == json.end() || *version != "2.0") {
    return refuse(RpcCode::kInvalidRequest, "expected \"jsonrpc\": \"2.0\"");
  }
  const auto method = json.find("method");
  if (method == json.end() || !method->is_string())
    return refuse(RpcCode::kInvalidRequest, "expected a method's name");
  RpcRequest request;
  request.method = method->get<std::string>();
  if (const auto params = json.find("params"); params != json.end()) {
    if (!params->is_object())
      return refuse(RpcCode::kInvalidRequest, "expected params by name, in an object");
    request.params = std::move(*params);
  }
  const auto id = json.find("id");
  request.notify = id == json.end();
  if (!request.notify) {
    if (!id->is_string() && !id->is_number() && !id->is_null()) {
      return refuse(RpcCode::kInvalidRequest, "expected an id that is a string, a number or null");
    }
    request.id = std::move(*id);
  }
  return request;
}

bool may_hold_estop(std::string_view text) {
  // JSON may spell any letter as \u and its number.
  return text.find(kEstopMethod) != std::string_view::npos || text.find("\\u") != std::string_view::npos;
}

bool is_estop(std::string_view line) {
  if (!may_hold_estop(line)) return false;
  const auto request = parse_request(line);
  return request.has_value() && request->method == kEstopMethod;
}

/// Does not throw: invalid UTF-8 from a peer is replaced.
std::string result_text(const Json& result) {
  return result.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string prepared_line(const Json& id, std::string_view result) {
  return fmt::format("{{\"id\":{},\"jsonrpc\":\"2.0\",\"result\":{}}}\n", result_text(id), result);
}

std::string result_line(const Json& id, const Json& result) { return prepared_line(id, result_text(result)); }

std::string error_line(const Json& id, const RpcError& error) {
  return dump(Json{{"jsonrpc", "2.0"},
                   {"id", id},
                   {"error", Json{{"code", static_cast<int>(error.code)}, {"message", error.message}}}});
}

std::string notification_line(std::string_view method, const Json& params) {
  return dump(Json{{"jsonrpc", "2.0"}, {"method", method}, {"params", params}});
}

std::string request_line(std::string_view method, const Json& params, int id) {
  return dump(Json{{"jsonrpc", "2.0"}, {"id", id}, {"method", method}, {"params", params}});
}

Result<Json> parse_answer(std::string_view line, int id) {
  Json json = Json::parse(line, nullptr, false);
  if (!json.is_object()) return fail(Errc::kProtocol, "the daemon's answer is no JSON object");
  if (const auto error = json.find("error"); error != json.end() && error->is_object()) {
    const auto code = error->find("code");
    const auto message = error->find("message");
    if (code == error->end() || !code->is_number_integer() || message == error->end() ||
        !message->is_string()) {
      return fail(Errc::kProtocol, "the daemon's error has no code or message");
    }
    return fail(to_errc(code->get<int>()), message->get<std::string>());
  }
  const auto result = json.find("result");
  const auto answer_id = json.find("id");
  if (result == json.end() || answer_id == json.end() || *answer_id != id) {
    return fail(Errc::kProtocol, "the daemon's answer belongs to no request of ours");
  }
  return Json(std::move(*result));
}

std::optional<Json> parse_notification(std::string_view line) {
  Json json = Json::parse(line, nullptr, false);
  if (!json.is_object() || !json.contains("method") || json.contains("id")) return {};
  const auto params = json.find("params");
  return params == json.end() ? Json::object() : Json(std::move(*params));
}

tl::expected<double, RpcError> real_param(const Json& params, const char* name) {
  const auto found = params.find(name);
  if (found == params.end())
    return refuse(RpcCode::kInvalidParams, fmt::format("{} is missing, expected a number", name));
  if (!found->is_number() || !(std::abs(found->get<double>()) <= kGreatestReal)) {  // also refuses NaN
    return refuse(RpcCode::kInvalidParams, fmt::format("{}: found {}, expected a number from {} to {}", name,
                                                       short_dump(*found), -kGreatestReal, kGreatestReal));
  }
  return found->get<double>();
}

tl::expected<std::string, RpcError> text_param(const Json& params, const char* name) {
  const auto found = params.find(name);
  if (found == params.end())
    return refuse(RpcCode::kInvalidParams, fmt::format("{} is missing, expected a string", name));
  if (!found->is_string()) {
    return refuse(RpcCode::kInvalidParams,
                  fmt::format("{}: found {}, expected a string", name, short_dump(*found)));
  }
  return found->get<std::string>();
}

tl::expected<std::vector<std::pair<double, double>>, RpcError> points_param(const Json& params,
                                                                            const char* name,
                                                                            std::size_t most) {
  const auto found = params.find(name);
  if (found == params.end())
    return refuse(RpcCode::kInvalidParams, fmt::format("{} is missing, expected [x, y, x, y, ...]", name));
  const auto is_number = [](const Json& value) {
    return value.is_number() && std::abs(value.get<double>()) <= kGreatestReal;
  };
  if (!found->is_array() || found->size() % 2 != 0 || found->size() > 2 * most ||
      !std::ranges::all_of(*found, is_number)) {
    return refuse(
        RpcCode::kInvalidParams,
        fmt::format("{}: found {}, expected [x, y, x, y, ...] of at most {} pairs of numbers from {} to {}",
                    name, short_dump(*found), most, -kGreatestReal, kGreatestReal));
  }
  std::vector<std::pair<double, double>> points;
  for (std::size_t i = 0; i < found->size(); i += 2)
    points.emplace_back((*found)[i].get<double>(), (*found)[i + 1].get<double>());
  return points;
}

tl::expected<std::uint64_t, RpcError> count_param(const Json& params, const char* name) {
  const auto found = params.find(name);
  if (found == params.end()) return 0;
  const bool negative = found->is_number_integer() && !found->is_number_unsigned() && *found < 0;
  if (!found->is_number_integer() || negative || found->get<std::uint64_t>() > kGreatestCount) {
    return refuse(RpcCode::kInvalidParams, fmt::format("{}: found {}, expected a whole number from 0 to 2^53",
                                                       name, short_dump(*found)));
  }
  return found->get<std::uint64_t>();
}

tl::expected<bool, RpcError> switch_param(const Json& params, const char* name) {
  const auto found = params.find(name);
  if (found == params.end()) return false;
  if (!found->is_boolean()) {
    return refuse(RpcCode::kInvalidParams,
                  fmt::format("{}: found {}, expected true or false", name, short_dump(*found)));
  }
  return found->get<bool>();
}

std::optional<RpcError> only_params(const Json& params, std::initializer_list<std::string_view> allowed) {
  for (const auto& [name, value] : params.items()) {
    if (std::find(allowed.begin(), allowed.end(), name) == allowed.end()) {
      return RpcError{RpcCode::kInvalidParams, fmt::format("unknown parameter {}", short_dump(Json(name)))};
    }
  }
  return {};
}

}  // namespace topo::daemon
