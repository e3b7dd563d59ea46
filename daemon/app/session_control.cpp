// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/app/session_control.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <utility>

#include "core/pipeline/mapping_step.hpp"
#include "daemon/config/key_table.hpp"
#include "daemon/recording/format.hpp"
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
constexpr types::Duration kTryAgain = std::chrono::seconds(10);

/// Faults of a session's file that are worth a report; that a killed daemon did not close its journal is not
/// one.
std::string lacks(const LoadedSession& file) {
  return file.closed || file.damaged > 0 || file.records_lost > 0 ? damage_text(file) : std::string();
}

auto no_folder() {
  return fail(Errc::kInvalidInput, "session.folder is not configured: no sessions are kept");
}

}  // namespace

std::uint64_t params_hash(const Configuration& configuration) {
  std::string text;
  for (const KeySpec& key : key_table()) {
    const std::string_view section = key.section();
    if (section != "mapping" && !section.starts_with("scanner.")) continue;
    if (key.name() == "address" || key.name() == "serial_number") continue;
    text += fmt::format("{}={}\n", key.path, value_text(key, configuration));
  }
  return checksum(std::as_bytes(std::span(text)));
}

SessionControl::SessionControl(const Configuration& configuration, HandOvers& hand_overs, Background& files)
    : configuration_(configuration),
      hand_overs_(hand_overs),
      files_(files),
      client_(hand_overs.files_desk, hand_overs.mapping.wakeup),
      params_hash_(params_hash(configuration)) {
  const SessionConfig& config = configuration_.session;
  resuming_ = !config.folder.empty() && !config.resume.empty();
  if (!resuming_) return;
  obstacle_ = "the last session is being looked for";
  hand_overs_.journal.held.store(true, std::memory_order_release);
}

void SessionControl::tick(types::Stamp now, bool has_map) {
  if (!resuming_ || loading_ || !has_map || now < next_try_) return;
  resume(now);
}

void SessionControl::release() {
  resuming_ = held_back_ = false;
  obstacle_.clear();
  hand_overs_.journal.held.store(false, std::memory_order_release);
  hand_overs_.journal.wakeup.post();
}

std::string SessionControl::obstacle() const {
  return loading_ != nullptr && loading_->asked_for ? "a session is being loaded" : obstacle_;
}

Status SessionControl::begin_anew() {
  auto stage = Stage::kLookedAt;
  if (loading_ != nullptr &&
      !loading_->stage.compare_exchange_strong(stage, Stage::kDropped, std::memory_order_acq_rel))
    return fail(Errc::kBusy, "the session is being taken over at this moment");
  if (loading_ != nullptr || resuming_) spdlog::info("session: begun anew, on the operator's word");
  loading_.reset();  // its job ends when it notices; the next request waits behind it
  release();
  return {};
}

/// Runs `job` with `loading` in the background. At most one loading is active at a time: the caller has
/// checked loading_.
template <class Job>
Status SessionControl::dispatch(std::shared_ptr<Loading> loading, Job job) {
  auto added = files_.add([loading, job = std::move(job)] { return job(loading); });
  if (added) loading_ = std::move(loading);
  return added;
}

/// A dropped loading may have a successor.
void SessionControl::end(const std::shared_ptr<Loading>& loading) {
  if (loading_ == loading) loading_.reset();
}

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
  Resumed resumed;
  const auto last = wanted();
  if (!last) {
    resumed.unusable = last.error().message;
    return resumed;
  }
  resumed.passed_over = last->unusable;
  if (!last->session) return resumed;
  resumed.name = last->session->entry.name;
  const LoadedSession& file = last->session->loaded;
  if (!file.closed || configuration_.session.resume != "killed") resumed.loaded = go_on(file, loading);
  return resumed;
}

void SessionControl::resume(types::Stamp now) {
  next_try_ = now + kTryAgain;
  auto job = [this](const std::shared_ptr<Loading>& loading) -> Background::Finish {
    return [this, loading, resumed = try_resume(*loading)] {
      end(loading);
      if (resuming_) settle(resumed);
    };
  };
  (void)dispatch(std::make_shared<Loading>(), job);  // when refused, it is tried again later
}

void SessionControl::settle(const Resumed& resumed) {
  // The attempt may be repeated; each is told once.
  for (const std::string& why : resumed.passed_over) {
    if (!passed_over_.insert(why).second) continue;
    spdlog::warn("session.resume: {}; the one before it counts instead", why);
  }
  if (!resumed.unusable.empty()) {
    // Another map has another origin, and the forbidden areas would be measured from there.
    return hold_back(
        fmt::format("the session to go on with cannot be used: {} (topoctl session load NAME, or "
                    "topoctl session new)",
                    resumed.unusable));
  }
  if (!resumed.loaded) return release();
  const Result<Loaded>& loaded = *resumed.loaded;
  if (loaded) {
    tell(resumed.name, *loaded);
    return release();
  }
  hold_back(
      fmt::format("the robot does not know where it is in session {0}: {1} (topoctl session load {0} "
                  "--pose X Y THETA, or topoctl session new)",
                  resumed.name, loaded.error().message));
}

/// The attempt is repeated; only a changed reason is reported.
void SessionControl::hold_back(const std::string& why) {
  if (why != obstacle_) spdlog::warn("session.resume: {}", why);
  obstacle_ = why;
  held_back_ = true;
}

void SessionControl::tell(const std::string& name, const Loaded& loaded) {
  if (!loaded.damage.empty())
    spdlog::warn("session {}: {}; what is whole is gone on with", name, loaded.damage);
  spdlog::info("session {}: goes on with {} keyframes; {}", name, loaded.keyframes, loaded.place);
}

void SessionControl::list(const Done& done) {
  auto job = [folder = configuration_.session.folder, done]() -> Background::Finish {
    if (folder.empty()) return [done] { done(no_folder()); };
    const auto sessions = list_sessions(folder);
    if (!sessions) return [done, error = sessions.error()] { done(tl::unexpected(error)); };
    Json entries = Json::array();
    for (const SessionEntry& s : *sessions) {
      entries.push_back({{"name", s.name},
                         {"bytes", s.bytes},
                         {"written_s", s.written_s},
                         {"journal", s.journal},
                         {"fault", header_fault(s.path)}});
    }
    return [done, json = Json{{"folder", folder}, {"sessions", std::move(entries)}}] { done(json); };
  };
  if (const auto added = files_.add(std::move(job)); !added) done(tl::unexpected(added.error()));
}

void SessionControl::save(const std::string& name, const Done& done) {
  const std::string& folder = configuration_.session.folder;
  if (folder.empty()) return done(no_folder());
  if (!is_session_name(name) || is_journal_name(name)) {
    return done(
        fail(Errc::kInvalidInput,
             fmt::format("name: found \"{}\", expected 1 to 64 letters, digits, - and _, not \"journal-...\"",
                         name)));
  }
  auto job = [this, path = session_path(folder, name), done]() -> Background::Finish {
    return [done, saved = save_now(path)] { done(saved); };
  };
  if (const auto added = files_.add(std::move(job)); !added) done(tl::unexpected(added.error()));
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

void SessionControl::load(const std::string& name, const std::optional<types::Se2>& pose, const Done& done) {
  const std::string& folder = configuration_.session.folder;
  if (folder.empty()) return done(no_folder());
  if (!is_session_name(name))
    return done(
        fail(Errc::kInvalidInput, fmt::format("name: found \"{}\", expected a session's name", name)));
  if (loading_ != nullptr) return done(fail(Errc::kBusy, "a session is being loaded already"));
  auto job = [this, path = session_path(folder, name), name,
              done](const std::shared_ptr<Loading>& loading) -> Background::Finish {
    const Result<Loaded> loaded = load_now(path, *loading);
    return [this, loading, loaded, name, done] {
      end(loading);
      if (!loaded) return done(tl::unexpected(loaded.error()));
      release();
      tell(name, *loaded);
      done(Json{{"name", name},
                {"keyframes", loaded->keyframes},
                {"closed", loaded->closed},
                {"other_parameters", loaded->other_params},
                {"damage", loaded->damage},
                {"place", loaded->place},
                {"pose",
                 {{"x_m", loaded->T_map_base.x_m},
                  {"y_m", loaded->T_map_base.y_m},
                  {"theta_rad", loaded->T_map_base.theta_rad}}}});
    };
  };
  auto loading = std::make_shared<Loading>();
  loading->asked_for = true;
  loading->near = pose;
  if (const auto added = dispatch(std::move(loading), std::move(job)); !added)
    done(tl::unexpected(added.error()));
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
  const auto found = place(session, *news, loading);
  if (!found) return tl::unexpected(found.error());
  if (auto s = hand_over(session, *news, found->match, loading); !s) return tl::unexpected(s.error());
  return Loaded{
      session.keyframes.size(), file.closed, file.params_hash != params_hash_, lacks(file), describe(*found),
      found->match.T_map_base};
}

/// The pose of the newest scan in the session. When two places look alike, a robot that was only restarted is
/// near the end of the session's path.
Result<slam::Localisation> SessionControl::place(const slam::Session& session, const SessionNews& news,
                                                 const Loading& loading) const {
  const slam::MapperParams params = mapper_params(configuration_);
  slam::Localisation found = loading.near ? slam::localise_near(session, news.cloud, *loading.near, params)
                                          : slam::localise_anywhere(session, news.cloud, params);
  if (!found.found() && found.refusal != slam::LocaliseRefusal::kNothingFits && !loading.asked_for) {
    slam::LocaliseParams last;  // it rolled on until the firmware's watchdog or topometric-estop stopped it
    last.window = {3.0, 1.0};
    last.guess_sigma_m = 1.5;
    last.guess_sigma_rad = 0.5;
    found = slam::localise_near(session, news.cloud, session.poses.back(), params, last);
  }
  if (!found.found()) return fail(Errc::kBusy, describe(found));
  return found;
}

/// Draws the map here, so that the mapping thread only has to adopt it.
Status SessionControl::hand_over(const slam::Session& session, const SessionNews& news,
                                 const slam::Match& match, Loading& loading) {
  auto* slot = hand_overs_.mapping.take_over.try_acquire();
  if (slot == nullptr)
    return fail(Errc::kBusy, "the mapping thread has not taken the session before over yet");
  slot->content = std::make_unique<pipeline::MappingState>(
      mapper_params(configuration_), session,
      slam::Arrival{news.cloud, news.T_odom_base, match.T_map_base, match.scan_information},
      new_maker(configuration_.robot.id));
  auto stage = Stage::kLookedAt;
  if (!loading.stage.compare_exchange_strong(stage, Stage::kHandedOver, std::memory_order_acq_rel)) {
    slot->content.reset();
    return fail(Errc::kBusy, "a map was begun anew meanwhile (topoctl session new)");
  }
  hand_overs_.mapping.take_over.commit();
  SessionAsk known;
  known.map = news.map;
  known.revision = news.revision;
  known.keyframes = news.session.keyframes.size();
  const types::Stamp limit = io::monotonic_now() + kPatience;
  while (io::monotonic_now() < limit) {
    const auto answer = client_.ask(known, kPatience);
    if (answer != nullptr && answer->map != news.map) return {};
  }
  return fail(Errc::kTimeout, "the mapping thread does not take the session over");
}

std::string SessionControl::trouble() const {
  if (journal_.failing) return fmt::format("it is not being kept: {}", journal_.message.view());
  return held_back_ ? obstacle_ : std::string();
}

Json SessionControl::status() const {
  return {{"folder", configuration_.session.folder},
          {"obstacle", obstacle()},
          {"journal",
           {{"name", journal_.name.view()},
            {"keyframes", journal_.keyframes},
            {"bytes", journal_.bytes},
            {"failures", journal_.failures},
            {"failing", journal_.failing},
            {"message", journal_.message.view()}}}};
}

}  // namespace topo::daemon
