// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/slam/placement.hpp"
#include "daemon/app/background.hpp"
#include "daemon/app/place_watch.hpp"
#include "daemon/config/configuration.hpp"
#include "daemon/control/json_rpc.hpp"
#include "daemon/session/last_usable.hpp"
#include "daemon/threads/hand_overs.hpp"

namespace topo::daemon {

/// Hash of the parameters that determine a map: the values of [mapping] and of the scanners' sections without
/// address and serial number.
[[nodiscard]] std::uint64_t params_hash(const Configuration& configuration);

/// The sessions that the operator saves and loads, and the one that the daemon resumes after a restart. Main
/// only, except for the jobs that it gives to the background thread. A map is taken over only when the robot
/// is localised in it and its place is a fact (slam::PlaceDoubt), or confirmed; until then nothing changes,
/// except that the robot stands. Both kinds of sessions follow this one way.
class SessionControl {
 public:
  using Done = std::function<void(types::Result<Json>)>;
  /// `files`: the thread of the jobs, which run one after the other; it ends before this object.
  SessionControl(const Configuration& configuration, HandOvers& hand_overs, Background& files);

  /// What asks mapping for its map; for jobs on the background thread.
  [[nodiscard]] SessionClient& client() { return client_; }

  /// To be called every tick: starts session.resume as soon as there is a scan, and repeats it until it is
  /// settled or a place is proposed. True once when a place was dropped: a mission cannot go on.
  bool tick(types::Stamp now, const MappingReport& report);
  /// Why a session prevents a mission; empty when none does.
  [[nodiscard]] std::string obstacle() const;

  void list(const Done& done);
  void save(const std::string& name, const Done& done);
  /// Continues a session: the robot is localised near the pose, or anywhere. The answer says whether the
  /// place is a proposal.
  void load(const std::string& name, const std::optional<types::Se2>& pose, const Done& done);
  /// Continues the session whose place is proposed, was dropped or not found: at the proposed place, or near
  /// the given pose. kNotFound when there is none, kInvalidInput when the pose is needed.
  void confirm(const std::optional<types::Se2>& pose, const Done& done);
  /// Drops the session to be resumed or loaded, even during its search: the map made since the start is kept.
  /// kBusy when the mapping thread is taking that session over.
  types::Status begin_anew();

  /// The session that waits for the operator's word; nothing: none does.
  [[nodiscard]] std::optional<PlaceOffer> waiting() const { return place_.waiting(); }

  [[nodiscard]] Json status() const;
  /// A fault of the sessions, for the operator; empty: none.
  [[nodiscard]] std::string trouble() const;
  [[nodiscard]] types::PlaceStanding standing() const { return place_.standing(); }
  [[nodiscard]] const JournalReport& journal() const { return journal_; }
  void note(const JournalReport& journal) { journal_ = journal; }

 private:
  /// Result of a load.
  struct Loaded {
    std::size_t keyframes = 0;
    bool closed = false, other_params = false;
    std::string damage;  ///< of the file, damage_text()
    std::string place;   ///< one sentence
    types::Se2 T_map_base;
    bool proposal = false;  ///< not taken over: the operator has to confirm it
    std::uint64_t map = 0;  ///< number of the mapper's map when taken over
  };
  /// Result of session.resume.
  struct Resumed {
    std::string name, path;
    std::string unusable;                  ///< why there is no session that can be read; empty: there is
    std::vector<std::string> passed_over;  ///< later journals that cannot be used, and why
    std::optional<types::Result<Loaded>> loaded;  ///< nothing: unusable, or there is none to resume
  };
  /// Progress of a session that is being loaded.
  enum class Stage : std::uint8_t {
    kLookedAt,    ///< can be dropped
    kHandedOver,  ///< is or will be the map
    kDropped,     ///< no longer needed
  };
  /// A session that is to become the map. Shared by both threads.
  struct Loading {
    bool asked_for = false;          ///< by the operator; false: by session.resume
    bool dropped_before = false;     ///< slam::PlacementCase
    std::optional<types::Se2> near;  ///< search region; nothing: anywhere
    std::atomic<Stage> stage{Stage::kLookedAt};
  };
  template <class Job>
  types::Status dispatch(std::shared_ptr<Loading> loading, Job job);
  void end(const std::shared_ptr<Loading>& loading);
  void resume(types::Stamp now);
  void settle(const Resumed& resumed);
  void go_on_with(const PlaceOffer& session, const std::optional<types::Se2>& near, const Done& done);
  void begin_fresh_map();
  void accept(const PlaceOffer& session, const Loaded& loaded);
  void release();
  // On the background thread.
  Resumed try_resume(Loading& loading);
  Resumed resume_last(Loading& loading);
  void give_to_team(JournalledItems items);
  types::Result<Json> save_now(const std::string& path);
  types::Result<Loaded> load_now(const std::string& path, Loading& loading);
  types::Result<Loaded> go_on(const LoadedSession& file, Loading& loading);
  types::Result<std::uint64_t> hand_over(const slam::Session& session, const SessionNews& news,
                                         const slam::Placement& found, Loading& loading);
  types::Status begin_fresh_now();
  types::Result<std::uint64_t> new_map_after(const SessionNews& news);
  types::Result<LastUsable> wanted() const;

  const Configuration& configuration_;
  HandOvers& hand_overs_;
  Background& files_;
  SessionClient client_;        ///< used on the background thread
  bool given_to_team_ = false;  ///< the same
  std::uint64_t params_hash_;
  std::set<std::string> passed_over_;  ///< unusable journals that were reported
  PlaceWatch place_;
  bool resuming_ = false;             ///< session.resume is not settled yet
  std::shared_ptr<Loading> loading_;  ///< null: none is active
  types::Stamp next_try_{};
  JournalReport journal_;
};

}  // namespace topo::daemon
