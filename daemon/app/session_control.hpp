// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "core/slam/localise.hpp"
#include "daemon/app/background.hpp"
#include "daemon/config/configuration.hpp"
#include "daemon/control/json_rpc.hpp"
#include "daemon/session/folder.hpp"
#include "daemon/session/session_reader.hpp"
#include "daemon/threads/hand_overs.hpp"

namespace topo::daemon {

/// Hash of what a map is made with: the values of [mapping] and of the scanners' places.
[[nodiscard]] std::uint64_t params_hash(const Configuration& configuration);

/// The sessions that the operator saves and loads, and the one that the daemon goes on with after a restart.
/// Main only, but for the jobs that it gives to the background thread; a map is taken over only when the
/// robot knows where it is in it, and else everything stays as it is.
class SessionControl {
 public:
  using Done = std::function<void(types::Result<Json>)>;
  /// `files`: the thread that the jobs run on, one after the other; ended before this.
  SessionControl(const Configuration& configuration, HandOvers& hand_overs, Background& files);

  /// Every tick: begins what session.resume asks for as soon as there is a scan, and tries again until it is
  /// done.
  void tick(types::Stamp now, bool has_map);
  /// Why the robot cannot be sent off because of a session; empty when it can.
  [[nodiscard]] std::string obstacle() const;

  void list(const Done& done);
  void save(const std::string& name, const Done& done);
  /// Goes on with a session: the robot is looked for around the pose, or anywhere.
  void load(const std::string& name, const std::optional<types::Se2>& pose, const Done& done);
  /// Leaves the session alone that the daemon wanted to go on with, be it looked for at this moment: the map
  /// made since the start is the map. kBusy when the mapping thread is taking that session over.
  types::Status begin_anew();

  [[nodiscard]] Json status() const;
  /// What is wrong with sessions, for a person; empty: nothing.
  [[nodiscard]] std::string trouble() const;
  [[nodiscard]] const JournalReport& journal() const { return journal_; }
  void note(const JournalReport& journal) { journal_ = journal; }

 private:
  /// What a load found out.
  struct Loaded {
    std::size_t keyframes = 0;
    bool closed = false, other_params = false;
    std::string damage;  ///< of the file, damage_text()
    std::string place;   ///< one sentence
    types::Se2 T_map_base;
  };
  /// What became of session.resume.
  struct Resumed {
    std::string name;
    std::string unusable;                         ///< why what it names cannot be read; empty: it can
    std::optional<types::Result<Loaded>> loaded;  ///< nothing: unusable, or there is none to go on with
  };
  /// How far a session is that is on its way.
  enum class Stage : std::uint8_t {
    kLookedAt,    ///< can be dropped
    kHandedOver,  ///< is or will be the map
    kDropped,     ///< nobody wants it any more
  };
  /// A session that is to become the map. Both threads hold it.
  struct Loading {
    bool asked_for = false;          ///< by the operator; else by session.resume
    std::optional<types::Se2> near;  ///< where the robot is looked for; nothing: anywhere
    std::atomic<Stage> stage{Stage::kLookedAt};
  };
  template <class Job>
  types::Status dispatch(std::shared_ptr<Loading> loading, Job job);
  void end(const std::shared_ptr<Loading>& loading);
  void resume(types::Stamp now);
  void settle(const Resumed& resumed);
  void hold_back(const std::string& why);
  static void tell(const std::string& name, const Loaded& loaded);
  void release();
  // On the background thread.
  Resumed try_resume(Loading& loading);
  types::Result<Json> save_now(const std::string& path);
  types::Result<Loaded> load_now(const std::string& path, Loading& loading);
  types::Result<Loaded> go_on(const LoadedSession& file, Loading& loading);
  types::Result<slam::Localisation> place(const slam::Session& session, const SessionNews& news,
                                          const Loading& loading) const;
  types::Status hand_over(const slam::Session& session, const SessionNews& news, const slam::Match& match,
                          Loading& loading);
  /// The session that session.resume names; nothing when there is none to go on with.
  types::Result<std::optional<SessionEntry>> wanted() const;

  const Configuration& configuration_;
  HandOvers& hand_overs_;
  Background& files_;
  SessionClient client_;  ///< background thread
  std::uint64_t params_hash_;
  std::string obstacle_;              ///< because of session.resume
  bool held_back_ = false;            ///< it was tried in vain
  bool resuming_ = false;             ///< session.resume is not settled yet
  std::shared_ptr<Loading> loading_;  ///< null: none that is wanted
  types::Stamp next_try_{};
  JournalReport journal_;
};

}  // namespace topo::daemon
