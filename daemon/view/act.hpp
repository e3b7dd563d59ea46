// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "daemon/control/json_rpc.hpp"

namespace topo::daemon {

/// Longest message of a page, in bytes: that of an area with all the corners it may have is below.
inline constexpr std::size_t kMaxActBytes = 2048;
inline constexpr std::size_t kMaxCorners = 60;  ///< of an area, as the daemon takes it

/// What a page wants done: a JSON object {"act": NAME, "id": N, ...}.
struct Act {
  enum class Kind {
    kEstop,      ///< of the whole team; needs no token
    kAuthorise,  ///< "token": the page has it from now on
    kCommand,    ///< a call of the daemon; needs a token
    kReplay,     ///< of the time line (replay/time_line.hpp), whose wish are the params
  };
  Kind kind = Kind::kCommand;
  std::uint64_t id = 0;  ///< the page's number for the answer
  std::string token;     ///< of kAuthorise
  std::string method;    ///< of the daemon's control socket, but for kAuthorise and kReplay
  Json params = Json::object();
};

/// Reads one message. Hostile input: never throws. kInvalidInput says what was found and what is expected.
types::Result<Act> parse_act(std::string_view text);

}  // namespace topo::daemon
