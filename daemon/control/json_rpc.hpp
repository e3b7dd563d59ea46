// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/types/result.hpp"

namespace topo::daemon {

using Json = nlohmann::json;

// JSON-RPC 2.0, one object per line, no batches (https://www.jsonrpc.org/specification). A client's input is
// untrusted: its length and depth are limited, and no function here throws.

inline constexpr std::size_t kMaxRequestBytes = 16384;
inline constexpr int kMaxRequestDepth = 8;

/// The method that goes before all others.
inline constexpr std::string_view kEstopMethod = "estop";

/// Error codes: those of the specification, and two server-defined ones.
enum class RpcCode {
  kParseError = -32700,
  kInvalidRequest = -32600,
  kMethodNotFound = -32601,
  kInvalidParams = -32602,
  kInternalError = -32603,
  kForbidden = -32001,  ///< the peer may not command
  kRefused = -32002,    ///< understood but not executed: the message gives the reason
};

struct RpcError {
  RpcCode code = RpcCode::kInternalError;
  std::string message;
};

struct RpcRequest {
  std::string method;
  Json params = Json::object();
  Json id;              ///< string, number or null
  bool notify = false;  ///< no id: no answer is expected
};

/// Parses a request; on failure returns the error for the answer (id null, as the specification requires).
tl::expected<RpcRequest, RpcError> parse_request(std::string_view line);

/// False when no line of the text is a request of kEstopMethod; no more than a search.
bool may_hold_estop(std::string_view text);
/// True when the line is a request of kEstopMethod. Cheap for nearly all others.
bool is_estop(std::string_view line);

/// One line with its line feed.
std::string result_line(const Json& id, const Json& result);
std::string error_line(const Json& id, const RpcError& error);
/// The same in two steps, for a result that answers several requests: result_line(id, r) is
/// prepared_line(id, result_text(r)).
std::string result_text(const Json& result);
std::string prepared_line(const Json& id, std::string_view result_text);
std::string notification_line(std::string_view method, const Json& params);
std::string request_line(std::string_view method, const Json& params, int id);

/// The result of an answer with this id. Errors: kRefused and unknown methods as kUnsupported, kForbidden as
/// kPermission, kInvalidParams as kInvalidInput, all others and lines that are not an answer as kProtocol.
types::Result<Json> parse_answer(std::string_view line, int id);

/// The params when the line is a notification (a method without an id), otherwise nothing.
std::optional<Json> parse_notification(std::string_view line);

/// Largest magnitude of a client's number: the extent of a map, so that cell indices do not overflow.
inline constexpr double kGreatestReal = 1e5;

/// Member `name` of params. The error gives the parameter's name, the value found and the expected type.
tl::expected<double, RpcError> real_param(const Json& params, const char* name);
tl::expected<std::string, RpcError> text_param(const Json& params, const char* name);

/// Points as a flat list [x, y, x, y, ...] of at most `most` pairs.
tl::expected<std::vector<std::pair<double, double>>, RpcError> points_param(const Json& params,
                                                                            const char* name,
                                                                            std::size_t most);

/// A count, up to kGreatestCount; 0 when it is absent.
inline constexpr std::uint64_t kGreatestCount = 1ULL << 53U;  ///< what every JSON reader keeps exactly
tl::expected<std::uint64_t, RpcError> count_param(const Json& params, const char* name);

/// False when it is absent.
tl::expected<bool, RpcError> switch_param(const Json& params, const char* name);

/// An error when params contain a member other than `allowed`.
std::optional<RpcError> only_params(const Json& params, std::initializer_list<std::string_view> allowed);

}  // namespace topo::daemon
