// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/view/player.hpp"

#include <utility>

#include "daemon/view/replay/scene.hpp"
#include "daemon/view/replay/team_scene.hpp"
#include "daemon/view/shorten.hpp"
#include "drivers/io/posix.hpp"

namespace topo::daemon {
namespace {

constexpr std::chrono::milliseconds kPicturePeriod(200);

/// Date and time of the newest state; null: there is none.
Json date_of(const Story& story, double t_s) {
  Json utc;
  for (const StoryLine& state : story.states) {
    if (state.t_s > t_s) break;
    utc = state.json.value("utc", Json());
  }
  return utc;
}

}  // namespace

Player::Player(boost::asio::io_context& io, const Params& params, Board& board, BoardRules rules)
    : robot_(params.robot), board_(board), rules_(std::move(rules)), tick_(io), film_(params.grid) {
  board_.post(Topic::kLink, {{"joined", true}, {"why", ""}});
}

void Player::load(Played played, bool is_growing) {
  film_.load(std::move(played.map));
  played.map = {};
  played_ = std::move(played);
  is_growing_ = is_growing;
  line_.set_length(played_.story.length_s());
}

types::Status Player::take(const Json& wish) {
  if (auto done = line_.take(wish); !done) return done;
  show();
  return {};
}

void Player::tick() {
  tick_.expires_after(kPicturePeriod);
  tick_.async_wait([this](const boost::system::error_code& cancelled) {
    if (!cancelled) tick();
  });
  const types::Stamp now = io::monotonic_now();
  const double seconds = last_ == types::Stamp{} ? 0.0 : types::to_seconds(now - last_);
  last_ = now;
  if (!rules_.is_watched()) return;
  line_.advance(seconds);
  show();
}

void Player::show() {
  const double t_s = line_.position_s();
  const Story& story = played_.story;
  Json replay = line_.json();
  replay["session"] = played_.name;
  replay["log"] = !played_.log.empty();
  replay["growing"] = is_growing_;
  replay["utc"] = date_of(story, t_s);
  board_.post(Topic::kReplay, replay);
  board_.post(Topic::kStatus, shorten(Topic::kStatus, status_at(story, t_s, robot_)));
  board_.post(Topic::kGoals, shorten(Topic::kGoals, goals_at(story, t_s)));
  board_.post(Topic::kAreas, areas_at(story, t_s));
  board_.post(Topic::kPast, past_at(story, t_s));
  show_map(t_s);
  const Json team = with_last_places(team_at(story, t_s), story, t_s, film_.last_places());
  board_.post(Topic::kTeam, shorten(Topic::kTeam, team));
  rules_.changed();
}

void Player::show_map(double t_s) {
  if (!film_.show(keyframes_at(played_.story, t_s))) return;
  board_.post(Topic::kTrails, film_.trails());
  for (bool more = true; more;) {
    const Json tiles = film_.tiles(revision_);
    if (!board_.take_tiles(tiles)) return;
    revision_ = tiles["revision"].get<std::uint64_t>();
    more = tiles["more"].get<bool>();
  }
}

}  // namespace topo::daemon
