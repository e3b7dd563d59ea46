// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// The jobs of SessionControl on the background thread.
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <utility>

#include "core/pipeline/mapping_step.hpp"
#include "core/slam/found_relations.hpp"
#include "daemon/app/session_control.hpp"
#include "daemon/session/origin.hpp"
#include "daemon/session/session_writer.hpp"
#include "drivers/io/posix.hpp"

namespace topo::daemon {

using types::Errc;
using types::fail;
using types::Result;
using types::Status;

namespace {

constexpr types::Duration kPatience = std::chrono::seconds(5);

/// Faults of a session's file that are worth a report; that a killed daemon did not close its journal is not
/// one.
std::string lacks(const LoadedSession& file) {
  return file.closed || file.damaged > 0 || file.records_lost > 0 ? damage_text(file) : std::string();
}

}  // namespace

/// The session that session.resume names; nothing when there is none to resume.
Result<LastUsable> SessionControl::wanted() const {
  const SessionConfig& config = configuration_.session;
  const auto sessions = list_sessions(config.folder);
  if (!sessions) return tl::unexpected(sessions.error());
  if (config.resume == "killed" || config.resume == "last") {
    LastUsable last = last_usable_journal(*sessions);
    if (!last.session && !last.unusable.empty()) return fail(Errc::kInvalidInput, last.unusable.front());
    return last;
  }
  for (const SessionEntry& session : *sessions) {
    if (session.name != config.resume) continue;
    auto named = load_usable(session);
    if (!named) return tl::unexpected(named.error());
    return LastUsable{std::move(*named), {}};
  }
  return fail(Errc::kNotFound,
              fmt::format("{}: there is no such session", session_path(config.folder, config.resume)));
}

/// Loads the session of session.resume. With "killed", a session that was closed in order is not resumed.
SessionControl::Resumed SessionControl::try_resume(Loading& loading) {
  Resumed resumed = resume_last(loading);
  give_to_team({});  // unless there was a session: nothing more comes
  return resumed;
}

SessionControl::Resumed SessionControl::resume_last(Loading& loading) {
  Resumed resumed;
  const auto last = wanted();
  if (!last) {
    resumed.unusable = last.error().message;
    return resumed;
  }
  resumed.passed_over = last->unusable;
  if (!last->session) return resumed;
  resumed.name = last->session->entry.name;
  resumed.path = last->session->entry.path;
  const LoadedSession& file = last->session->loaded;
  if (!file.closed || configuration_.session.resume != "killed") {
    // Before the robot is looked for in it, which may take long, or be left to the operator.
    slam::Session session = claimed(file.session, configuration_.robot.id);
    std::vector<slam::FoundRelation> relations = slam::found_relations(session.keyframes, session.edges);
    give_to_team({std::move(session.keyframes), std::move(relations)});
    resumed.loaded = go_on(file, loading);
  }
  return resumed;
}

/// The items of a team stay true wherever this robot is now.
void SessionControl::give_to_team(JournalledItems items) {
  if (!configuration_.team.present || std::exchange(given_to_team_, true)) return;
  auto* slot = hand_overs_.team.journalled.try_acquire();
  if (slot == nullptr) return;
  slot->content = std::make_unique<JournalledItems>(std::move(items));
  hand_overs_.team.journalled.commit();
  hand_overs_.team.wakeup.post();
}

Result<Json> SessionControl::save_now(const std::string& path) {
  const auto news = client_.ask({}, kPatience);
  if (news == nullptr) return fail(Errc::kTimeout, "the mapping thread does not answer");
  if (news->session.keyframes.empty())
    return fail(Errc::kNotFound, "there is no map yet: no scan was matched since the start");
  if (auto s = save_session(path, news->session, params_hash_); !s) return tl::unexpected(s.error());
  spdlog::info("session of {} keyframes saved to {}", news->session.keyframes.size(), path);
  return Json{{"file", path}, {"keyframes", news->session.keyframes.size()}, {"revision", news->revision}};
}

Result<SessionControl::Loaded> SessionControl::load_now(const std::string& path, Loading& loading) {
  const auto usable = load_usable({.name = {}, .path = path});
  if (!usable) return tl::unexpected(usable.error());
  return go_on(usable->loaded, loading);
}

/// Precondition: check_map().
Result<SessionControl::Loaded> SessionControl::go_on(const LoadedSession& file, Loading& loading) {
  SessionAsk ask;
  ask.sighting = true;
  const auto news = client_.ask(ask, kPatience);
  if (news == nullptr) return fail(Errc::kTimeout, "the mapping thread does not answer");
  if (news->session.keyframes.empty()) return fail(Errc::kBusy, "no scan came since the start");
  const slam::Session session = claimed(file.session, configuration_.robot.id);
  const slam::Placement found =
      slam::place_in(session, news->cloud,
                     {loading.near, hand_overs_.place.limited.load(std::memory_order_acquire),
                      loading.dropped_before, static_cast<std::uint16_t>(configuration_.robot.id)},
                     mapper_params(configuration_));
  if (!found.found()) return fail(Errc::kBusy, describe(found));
  Loaded loaded{session.keyframes.size(),
                file.closed,
                file.params_hash != params_hash_,
                lacks(file),
                describe(found),
                found.place.match.T_map_base,
                !found.is_fact(),
                0};
  if (loaded.proposal) return loaded;
  const auto map = hand_over(session, *news, found, loading);
  if (!map) return tl::unexpected(map.error());
  loaded.map = *map;
  return loaded;
}

/// Draws the map here, so that the mapping thread only has to adopt it. The base stops counting on its place,
/// and the journal stops, before the mapping thread can take the map.
Result<std::uint64_t> SessionControl::hand_over(const slam::Session& session, const SessionNews& news,
                                                const slam::Placement& found, Loading& loading) {
  auto* slot = hand_overs_.mapping.take_over.try_acquire();
  if (slot == nullptr)
    return fail(Errc::kBusy, "the mapping thread has not taken the session before over yet");
  const slam::Match& match = found.place.match;
  slam::Arrival arrival{news.cloud, news.T_odom_base, match.T_map_base, match.scan_information};
  for (const slam::Match& other : found.others) arrival.rivals.push_back(other.T_map_base);
  slot->content = std::make_unique<pipeline::MappingState>(mapper_params(configuration_), session, arrival,
                                                           new_maker(configuration_.robot.id));
  auto stage = Stage::kLookedAt;
  if (!loading.stage.compare_exchange_strong(stage, Stage::kHandedOver, std::memory_order_acq_rel)) {
    slot->content.reset();
    return fail(Errc::kBusy, "a map was begun anew meanwhile (topoctl session new)");
  }
  hand_overs_.place.standing.store(types::PlaceStanding::kUnknown, std::memory_order_release);
  hand_overs_.journal.held.store(true, std::memory_order_release);
  hand_overs_.mapping.take_over.commit();
  return new_map_after(news);
}

Status SessionControl::begin_fresh_now() {
  const auto news = client_.ask({}, kPatience);
  if (news == nullptr) return fail(Errc::kTimeout, "the mapping thread does not answer");
  auto* slot = hand_overs_.mapping.take_over.try_acquire();
  if (slot == nullptr)
    return fail(Errc::kBusy, "the mapping thread has not taken the session before over yet");
  slot->content = std::make_unique<pipeline::MappingState>(mapper_params(configuration_),
                                                           new_maker(configuration_.robot.id));
  hand_overs_.mapping.take_over.commit();
  if (const auto map = new_map_after(*news); !map) return tl::unexpected(map.error());
  return {};
}

/// Waits until the mapping thread has another map than in `news`; its number.
Result<std::uint64_t> SessionControl::new_map_after(const SessionNews& news) {
  SessionAsk known;
  known.map = news.map;
  known.revision = news.revision;
  known.keyframes = news.session.keyframes.size();
  const types::Stamp limit = io::monotonic_now() + kPatience;
  while (io::monotonic_now() < limit) {
    const auto answer = client_.ask(known, kPatience);
    if (answer != nullptr && answer->map != news.map) return answer->map;
  }
  return fail(Errc::kTimeout, "the mapping thread does not take the session over");
}

}  // namespace topo::daemon
