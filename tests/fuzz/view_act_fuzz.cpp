// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// Messages of pages, and what a browser says of itself: never an exception, and nothing but the acts of the
// page comes through.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "daemon/view/act.hpp"
#include "daemon/view/board.hpp"
#include "daemon/view/request_check.hpp"
#include "daemon/view/tokens.hpp"

namespace {

using topo::daemon::Act;

void require(bool holds) {
  if (!holds) std::abort();
}

/// Those that an act passes on, whatever else its message holds.
std::size_t parameters_of(const Act& act) {
  if (act.method == "goto") return 2;
  if (act.method == "session.confirm") return 3;  // a pose
  if (act.method == "area.draw") return act.params.contains("kind") ? 2 : 1;
  return act.method == "area.withdraw" || act.params.contains("all") ? 1 : 0;
}

void check(const Act& act) {
  constexpr std::array<std::string_view, 11> kMethods{
      "area.draw", "area.withdraw", "estop",       "start", "home",           "pause",
      "resume",    "stop",          "clear_estop", "goto",  "session.confirm"};
  if (act.kind == Act::Kind::kAuthorise) return require(act.token.size() <= 64 && act.method.empty());
  if (act.kind == Act::Kind::kReplay) return require(act.params.size() <= 3 && act.method.empty());
  require(std::ranges::count(kMethods, act.method) == 1);
  require((act.kind == Act::Kind::kEstop) == (act.method == "estop"));
  require(act.params.size() == parameters_of(act));
  if (act.method == "area.draw") require(act.params["corners_m"].size() <= 2 * topo::daemon::kMaxCorners);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  if (const auto act = topo::daemon::parse_act(text)) check(*act);
  // A name of ours is ours only as a whole.
  if (topo::daemon::is_own_host(text, {"robot1"})) require(text.size() <= 260 && text.find('/') == text.npos);
  if (!text.empty() && topo::daemon::is_own_origin(text, "robot1:8080")) require(text.ends_with(":8080"));
  if (const auto tokens = topo::daemon::parse_tokens(text)) {
    const auto again = topo::daemon::parse_tokens(topo::daemon::tokens_text(*tokens));
    require(again.has_value() && *again == *tokens);
  }
  topo::daemon::Board board;
  const auto answer = topo::daemon::Json::parse(text, nullptr, false);
  if (answer.is_object() && board.take_tiles(answer)) (void)board.tiles_after(0, 16'000).message.dump();
  return 0;
}
