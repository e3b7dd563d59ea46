// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// Lines of the control socket, from clients of any kind: never an exception, and every answer is one line.
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "daemon/control/json_rpc.hpp"
#include "daemon/control/line_buffer.hpp"

namespace {

void require_one_line(const std::string& answer) {
  if (answer.empty() || answer.find('\n') != answer.size() - 1) std::abort();
}

void answer(const std::string& line) {
  const auto request = topo::daemon::parse_request(line);
  if (!request.has_value()) {
    require_one_line(topo::daemon::error_line(nullptr, request.error()));
    return;
  }
  static_cast<void>(topo::daemon::real_param(request->params, "x"));
  static_cast<void>(topo::daemon::text_param(request->params, "name"));
  static_cast<void>(topo::daemon::only_params(request->params, {"x", "name"}));
  require_one_line(topo::daemon::result_line(request->id, request->params));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  topo::daemon::LineBuffer lines(topo::daemon::kMaxRequestBytes);
  if (!lines.append(bytes)) return 0;
  while (const auto line = lines.take_line()) {
    answer(*line);
    static_cast<void>(topo::daemon::parse_answer(*line, 1));
  }
  return 0;
}
