// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/view/feed.hpp"

#include <spdlog/spdlog.h>

#include <utility>

#include "daemon/view/shorten.hpp"
#include "drivers/io/posix.hpp"

namespace topo::daemon {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr milliseconds kTick(50);
// A keyframe, with which the map changes, comes at most about once a second.
constexpr types::Duration kMapPeriod = seconds(1);

}  // namespace

Feed::Feed(boost::asio::io_context& io, const std::string& socket, Board& board, BoardRules rules)
    : board_(board),
      rules_(std::move(rules)),
      line_(io, socket,
            {[this] { on_joined(); }, [this](const std::string& why) { on_lost(why); },
             [this](const Json& event) {
               board_.add_event(event);
               rules_.changed();
             }}),
      tick_(io),
      // 5 Hz of state; who has acknowledged an order within half a second; planning's period is 0.4 s.
      questions_{{{"status", Topic::kStatus, milliseconds(200)},
                  {"team", Topic::kTeam, milliseconds(500)},
                  {"goals", Topic::kGoals, seconds(1)},
                  {"places", Topic::kPlaces, seconds(3)},
                  {"health", Topic::kHealth, seconds(2)},
                  {"doctor", Topic::kDoctor, seconds(10)},
                  {"map.trails", Topic::kTrails, seconds(5)},
                  {"map.doubt", Topic::kDoubt, seconds(5)},
                  {"areas", Topic::kAreas, milliseconds(500)},
                  {"scan", Topic::kScan, milliseconds(500)}}} {}

void Feed::start() {
  line_.start();
  tick();
}

void Feed::tick() {
  tick_.expires_after(kTick);
  tick_.async_wait([this](const boost::system::error_code& cancelled) {
    if (!cancelled) tick();
  });
  if (!line_.joined() || !rules_.is_watched()) return;
  const types::Stamp now = io::monotonic_now();
  for (Question& question : questions_)
    if (!question.under_way && now >= question.due) ask(question, now);
  if (!map_under_way_ && now >= map_due_) ask_for_map(now);
}

void Feed::ask(Question& question, types::Stamp now) {
  question.under_way = true;
  question.due = now + question.period;
  line_.call(question.method, Json::object(), [this, &question](const types::Result<Json>& answer) {
    question.under_way = false;
    if (!answer) return;  // no map yet, or the line was lost, which on_lost() says
    if (question.topic == Topic::kStatus) note_place(*answer);
    board_.post(question.topic, shorten(question.topic, *answer));
    rules_.changed();
  });
}

/// Where the robot is, the operator shows in the map of the session that asks for it.
void Feed::note_place(const Json& status) {
  const Json::json_pointer waits("/session/place/waits"), session("/session/place/session");
  const bool asks = status.contains(waits) && status[waits] == true && status.contains(session) &&
                    status[session].is_string();
  const std::string waiting = asks ? status[session].get<std::string>() : "";
  if (waiting == waiting_) return;
  waiting_ = waiting;
  map_revision_ = 0;
  map_due_ = {};
  board_.forget_map();
}

void Feed::ask_for_map(types::Stamp now) {
  map_under_way_ = true;
  map_due_ = now + kMapPeriod;
  const char* method = waiting_.empty() ? "map.tiles" : "session.tiles";
  const auto take = [this, of = waiting_](const types::Result<Json>& answer) {
    map_under_way_ = false;
    if (of != waiting_ || !answer || !board_.take_tiles(*answer)) return;
    map_revision_ = answer->value("revision", std::uint64_t{0});
    if (answer->value("more", false)) map_due_ = {};
    rules_.changed();
  };
  line_.call(method, Json{{"since", map_revision_}}, take);
}

/// Another daemon may have another map, whose changes count from the beginning.
void Feed::on_joined() {
  lost_.clear();
  waiting_.clear();
  map_revision_ = 0;
  board_.forget_map();
  board_.post(Topic::kLink, {{"joined", true}, {"why", ""}});
  spdlog::info("the daemon answers");
  line_.call("events.subscribe", Json::object(), [](const types::Result<Json>&) {});
  rules_.changed();
}

void Feed::on_lost(const std::string& why) {
  // Pages hear it with every attempt, once a second: they know then that topoview itself is alive.
  board_.post(Topic::kLink, {{"joined", false}, {"why", why}});
  if (lost_ != why) spdlog::warn("{}", why);
  lost_ = why;
  rules_.changed();
}

}  // namespace topo::daemon
