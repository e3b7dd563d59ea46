// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "core/types/stamp.hpp"
#include "daemon/session/journal_file.hpp"
#include "daemon/session/mission_log_file.hpp"
#include "daemon/threads/hand_overs.hpp"
#include "daemon/threads/vitals.hpp"
#include "daemon/threads/worker.hpp"

namespace topo::daemon {

/// Settings of the journal, which keeps the session while it grows.
struct JournalSettings {
  std::string folder;
  types::Duration period = std::chrono::seconds(2);
  std::size_t keep = 5;  ///< journals to keep, including the current one
  std::uint64_t params_hash = 0;
  std::uint64_t quota_bytes = 0;  ///< of all journals, and of all mission logs a twentieth; 0: no limit
};

/// The journal thread: writes the session into a file while it grows, so that mapping can continue the map of
/// a killed daemon, and the mission log beside it. It requests keyframes by their numbers and loses none:
/// keyframes that a full disk did not accept are written later.
class JournalWorker final : public Worker {
 public:
  JournalWorker(HandOvers& hand_overs, JournalSettings settings, Vitals& vitals)
      : hand_overs_(hand_overs),
        settings_(std::move(settings)),
        vitals_(vitals),
        client_(hand_overs.journal.desk, hand_overs.mapping.wakeup) {}

  /// The thread's body: runs until hand_overs.ending.stopping; then writes the last keyframes and the record
  /// that the file is complete. The mapping thread must still answer then.
  void run() noexcept override;

 private:
  void pull();
  types::Status pull_map();
  void take(const SessionNews& news);
  types::Status keep();
  types::Status keep_log();
  void close();
  types::Status open();
  void remove_old();
  void remove_old_logs();
  void note(const types::Status& kept);

  HandOvers& hand_overs_;
  JournalSettings settings_;
  Vitals& vitals_;
  SessionClient client_;
  SessionAsk known_;
  slam::Session session_;
  std::optional<JournalFile> file_;
  std::optional<MissionLogFile> log_;
  std::uint64_t old_looked_at_ = 0;  ///< size of the file at which old journals are looked at again
  JournalReport report_;
  Rarely failed_;
};

}  // namespace topo::daemon
