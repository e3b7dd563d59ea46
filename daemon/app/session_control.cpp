// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/app/session_control.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <utility>

#include "daemon/config/key_table.hpp"
#include "daemon/recording/format.hpp"
#include "drivers/io/posix.hpp"

namespace topo::daemon {

using types::Errc;
using types::fail;
using types::Result;
using types::Status;

namespace {

constexpr types::Duration kTryAgain = std::chrono::seconds(10);

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
      params_hash_(params_hash(configuration)),
      place_(hand_overs) {
  const SessionConfig& config = configuration_.session;
  resuming_ = !config.folder.empty() && !config.resume.empty();
  if (resuming_) place_.seek("the last session is being looked for", false);
}

bool SessionControl::tick(types::Stamp now, const MappingReport& report) {
  const bool dropped = place_.note(report, now);
  if (loading_ != nullptr) return dropped;
  if (place_.wants_fresh_map()) {
    begin_fresh_map();
  } else if (resuming_ && report.keyframes > 0 && now >= next_try_) {
    resume(now);
  }
  return dropped;
}

void SessionControl::release() {
  resuming_ = false;
  place_.own();
}

std::string SessionControl::obstacle() const {
  return loading_ != nullptr && loading_->asked_for ? "a session is being loaded" : place_.obstacle();
}

Status SessionControl::begin_anew() {
  auto stage = Stage::kLookedAt;
  if (loading_ != nullptr &&
      !loading_->stage.compare_exchange_strong(stage, Stage::kDropped, std::memory_order_acq_rel))
    return fail(Errc::kBusy, "the session is being taken over at this moment");
  if (loading_ != nullptr || resuming_) spdlog::info("session: begun anew, on the operator's word");
  hand_overs_.team.begun_anew.store(true, std::memory_order_release);
  loading_.reset();  // its job ends when it notices; the next request waits behind it
  resuming_ = false;
  if (place_.on_trial() || place_.wants_fresh_map())
    place_.begin_anew();
  else
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

void SessionControl::resume(types::Stamp now) {
  next_try_ = now + kTryAgain;
  auto job = [this](const std::shared_ptr<Loading>& loading) -> Background::Finish {
    return [this, loading, resumed = try_resume(*loading)] {
      end(loading);
      if (resuming_) settle(resumed);
    };
  };
  auto loading = std::make_shared<Loading>();
  loading->dropped_before = place_.dropped_before();
  (void)dispatch(std::move(loading), job);  // when refused, it is tried again later
}

void SessionControl::settle(const Resumed& resumed) {
  // The attempt may be repeated; each is told once.
  for (const std::string& why : resumed.passed_over) {
    if (!passed_over_.insert(why).second) continue;
    spdlog::warn("session.resume: {}; the one before it counts instead", why);
  }
  if (!resumed.unusable.empty()) {
    // Another map has another origin, and the forbidden areas would be measured from there.
    return place_.seek(
        fmt::format("the session to go on with cannot be used: {} (topoctl session load NAME, or "
                    "topoctl session new)",
                    resumed.unusable),
        true);
  }
  if (!resumed.loaded) return release();
  const PlaceOffer session{resumed.name, resumed.path, std::nullopt};
  const Result<Loaded>& loaded = *resumed.loaded;
  if (loaded) return accept(session, *loaded);
  place_.seek(
      fmt::format(
          "the robot does not know where it is in session {0}: {1} (topoctl session confirm --pose X Y "
          "THETA, or topoctl session new)",
          resumed.name, loaded.error().message),
      true, session);
}

/// The session is the map now, or waits for the operator.
void SessionControl::accept(const PlaceOffer& session, const Loaded& loaded) {
  resuming_ = false;
  if (!loaded.damage.empty())
    spdlog::warn("session {}: {}; what is whole is gone on with", session.name, loaded.damage);
  const PlaceOffer offer{session.name, session.path, loaded.T_map_base};
  if (loaded.proposal) return place_.propose(offer, loaded.place);
  spdlog::info("session {}: goes on with {} keyframes; {}", session.name, loaded.keyframes, loaded.place);
  place_.take(offer, loaded.map, io::monotonic_now());
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
  if (place_.on_trial()) {
    return done(fail(Errc::kBusy,
                     "the robot's place in this map is on trial until it has driven some metres: nothing of "
                     "it is kept before"));
  }
  auto job = [this, path = session_path(folder, name), done]() -> Background::Finish {
    return [done, saved = save_now(path)] { done(saved); };
  };
  if (const auto added = files_.add(std::move(job)); !added) done(tl::unexpected(added.error()));
}

void SessionControl::load(const std::string& name, const std::optional<types::Se2>& pose, const Done& done) {
  const std::string& folder = configuration_.session.folder;
  if (folder.empty()) return done(no_folder());
  if (!is_session_name(name))
    return done(
        fail(Errc::kInvalidInput, fmt::format("name: found \"{}\", expected a session's name", name)));
  go_on_with({name, session_path(folder, name), std::nullopt}, pose, done);
}

void SessionControl::confirm(const std::optional<types::Se2>& pose, const Done& done) {
  const std::optional<PlaceOffer> offer = place_.waiting();
  if (!offer) {
    return done(
        fail(Errc::kNotFound,
             "no session waits for the robot's place (topoctl session load NAME --pose X Y THETA goes "
             "on with one)"));
  }
  const std::optional<types::Se2> near = pose ? pose : offer->T_map_base;
  if (!near) {
    return done(
        fail(Errc::kInvalidInput,
             fmt::format("pose: none is proposed in session {}, expected --pose X Y THETA", offer->name)));
  }
  go_on_with(*offer, near, done);
}

void SessionControl::go_on_with(const PlaceOffer& session, const std::optional<types::Se2>& near,
                                const Done& done) {
  if (loading_ != nullptr) return done(fail(Errc::kBusy, "a session is being loaded already"));
  if (place_.wants_fresh_map())
    return done(fail(Errc::kBusy, "a new map is being begun; try again in a moment"));
  auto job = [this, session, done](const std::shared_ptr<Loading>& loading) -> Background::Finish {
    const Result<Loaded> loaded = load_now(session.path, *loading);
    return [this, loading, loaded, session, done] {
      end(loading);
      if (!loaded && loading->stage == Stage::kHandedOver) place_.seek(loaded.error().message, true, session);
      if (!loaded) return done(tl::unexpected(loaded.error()));
      if (loading->stage == Stage::kDropped)
        return done(fail(Errc::kBusy, "a map was begun anew meanwhile (topoctl session new)"));
      accept(session, *loaded);
      done(Json{{"name", session.name},
                {"keyframes", loaded->keyframes},
                {"closed", loaded->closed},
                {"other_parameters", loaded->other_params},
                {"damage", loaded->damage},
                {"place", loaded->place},
                {"proposal", loaded->proposal},
                {"pose",
                 {{"x_m", loaded->T_map_base.x_m},
                  {"y_m", loaded->T_map_base.y_m},
                  {"theta_rad", loaded->T_map_base.theta_rad}}}});
    };
  };
  auto loading = std::make_shared<Loading>();
  loading->asked_for = true;
  loading->near = near;
  loading->dropped_before = place_.dropped_before();
  if (const auto added = dispatch(std::move(loading), std::move(job)); !added)
    done(tl::unexpected(added.error()));
}

/// In place of a map whose place was dropped: nothing of it may be kept or planned with.
void SessionControl::begin_fresh_map() {
  auto job = [this](const std::shared_ptr<Loading>& loading) -> Background::Finish {
    const Status begun = begin_fresh_now();
    return [this, loading, begun] {
      end(loading);
      if (begun) return place_.fresh_map_made();
      spdlog::warn("session: a new map was not begun: {}; tried again", begun.error().message);
    };
  };
  auto loading = std::make_shared<Loading>();
  loading->stage = Stage::kHandedOver;      // nothing may drop it
  (void)dispatch(std::move(loading), job);  // when refused, the next tick tries again
}

std::string SessionControl::trouble() const {
  if (journal_.failing) return fmt::format("it is not being kept: {}", journal_.message.view());
  return place_.trouble();
}

Json SessionControl::status() const {
  return {{"folder", configuration_.session.folder},
          {"obstacle", obstacle()},
          {"place", place_.json()},
          {"journal",
           {{"name", journal_.name.view()},
            {"keyframes", journal_.keyframes},
            {"bytes", journal_.bytes},
            {"failures", journal_.failures},
            {"failing", journal_.failing},
            {"message", journal_.message.view()}}}};
}

}  // namespace topo::daemon
