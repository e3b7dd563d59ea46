// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/threads/journal_worker.hpp"

#include <algorithm>
#include <ctime>
#include <limits>
#include <system_error>
#include <utility>

#include "daemon/logging/event_catalogue.hpp"
#include "daemon/session/folder.hpp"
#include "drivers/io/posix.hpp"

namespace topo::daemon {
namespace {

/// A robot that has not moved has no map to keep: a restart must not displace the journal of an actual map.
constexpr std::size_t kWorthKeeping = 2;
constexpr types::Duration kPatience = std::chrono::seconds(5);

/// An event's text is short: the system's message matters, the file is known.
std::string reason_of(const types::Error& error) {
  return error.sys_errno != 0 ? std::generic_category().message(error.sys_errno) : error.message;
}

}  // namespace

void JournalWorker::run() noexcept {
  while (!hand_overs_.ending.stopping.load(std::memory_order_acquire)) {
    hand_overs_.journal.wakeup.wait(settings_.period);
    vitals_.beat();
    const types::Stamp begin = io::monotonic_now();
    pull();
    vitals_.run.record((io::monotonic_now() - begin).count());
  }
  pull();
  close();
}

void JournalWorker::pull() {
  const types::Status kept = pull_map();
  const types::Status logged = keep_log();
  note(kept ? logged : kept);
}

types::Status JournalWorker::pull_map() {
  // While the robot is not localised in an older map, that map's journal stays the newest.
  if (hand_overs_.journal.held.load(std::memory_order_acquire)) return {};
  const auto news = client_.ask(known_, kPatience);
  if (news == nullptr) return {};
  if (news->changed) take(*news);
  return keep();
}

void JournalWorker::take(const SessionNews& news) {
  if (news.map != known_.map) {
    close();  // another map was taken over: it gets another journal
    session_ = {};
  }
  session_.keyframes.resize(news.first);
  session_.keyframes.insert(session_.keyframes.end(), news.session.keyframes.begin(),
                            news.session.keyframes.end());
  session_.poses = news.session.poses;
  session_.edges = news.session.edges;
  known_.map = news.map;
  known_.revision = news.revision;
  known_.keyframes = session_.keyframes.size();
}

types::Status JournalWorker::keep() {
  if (session_.keyframes.size() < kWorthKeeping) return {};
  if (!file_) {
    if (auto opened = open(); !opened) return opened;
  }
  const auto appended = file_->append(session_);
  if (!appended) return tl::unexpected(appended.error());
  remove_old();
  return {};
}

types::Status JournalWorker::keep_log() {
  std::string lines = hand_overs_.journal.log.take();
  if (lines.empty()) return {};
  if (!log_) {
    auto created = MissionLogFile::create(settings_.folder, static_cast<std::int64_t>(std::time(nullptr)));
    if (!created) {
      hand_overs_.journal.log.give_back(std::move(lines));
      return tl::unexpected(created.error());
    }
    log_.emplace(std::move(*created));
    remove_old_logs();
  }
  auto written = log_->append(lines);
  if (!written) hand_overs_.journal.log.give_back(std::move(lines));
  return written;
}

/// As many logs as journals stay, of a twentieth of their bytes: 1 Hz of state is small beside a map.
void JournalWorker::remove_old_logs() {
  constexpr std::uint64_t kShare = 20;
  std::vector<QuotaFile> logs = mission_logs(settings_.folder);
  const std::size_t keep = std::max<std::size_t>(settings_.keep, 1);
  while (logs.size() > keep && remove_finished(logs.front().path)) logs.erase(logs.begin());
  if (settings_.quota_bytes > 0) keep_to_quota(logs, settings_.quota_bytes / kShare);
}

types::Status JournalWorker::open() {
  const auto sessions = list_sessions(settings_.folder);
  if (!sessions) return tl::unexpected(sessions.error());
  const std::string name = next_journal_name(static_cast<std::int64_t>(std::time(nullptr)), *sessions);
  auto created = JournalFile::create(session_path(settings_.folder, name), settings_.params_hash);
  if (!created) return tl::unexpected(created.error());
  file_.emplace(std::move(*created));
  report_.name = name;
  old_looked_at_ = 0;
  return {};
}

/// After the first append and each further hundredth of the quota. Not before: a map must not be removed
/// while its successor is not on the disk.
void JournalWorker::remove_old() {
  if (file_->bytes() < old_looked_at_) return;
  old_looked_at_ = settings_.quota_bytes == 0 ? std::numeric_limits<std::uint64_t>::max()
                                              : file_->bytes() + settings_.quota_bytes / 100 + 1;
  auto sessions = list_sessions(settings_.folder);
  if (!sessions) return;  // the next append tells it
  if (remove_old_journals(*sessions, std::max<std::size_t>(settings_.keep, 1)) > 0)
    sessions = list_sessions(settings_.folder);
  if (!sessions || settings_.quota_bytes == 0) return;
  const QuotaResult kept = keep_journals_to_quota(*sessions, settings_.quota_bytes);
  if (kept.removed == 0) return;
  constexpr std::int64_t kMega = 1'000'000;
  post(vitals_.events, io::monotonic_now().time_since_epoch().count(), EventId::kOldJournalsRemoved,
       sync::Severity::kInfo,
       {static_cast<std::int64_t>(kept.removed), static_cast<std::int64_t>(kept.removed_bytes) / kMega,
        static_cast<std::int64_t>(settings_.quota_bytes) / kMega});
}

void JournalWorker::close() {
  if (!file_) return;
  note(file_->close(session_));
  file_.reset();
}

/// A full or missing disk is reported once a minute; mapping continues.
void JournalWorker::note(const types::Status& kept) {
  const types::Stamp now = io::monotonic_now();
  const bool failed_before = std::exchange(report_.failing, !kept.has_value());
  if (kept) {
    failed_.over();
    if (file_) {
      report_.keyframes = session_.keyframes.size();
      report_.bytes = file_->bytes();
    }
    if (failed_before) {
      post(vitals_.events, now.time_since_epoch().count(), EventId::kJournalGoesOn, sync::Severity::kInfo,
           {static_cast<std::int64_t>(report_.keyframes)});
    }
  } else {
    ++report_.failures;
    report_.message = kept.error().message;
    if (failed_.due(now)) {
      post(vitals_.events, now.time_since_epoch().count(), EventId::kJournalFailed, sync::Severity::kWarning,
           {static_cast<std::int64_t>(report_.failures)}, reason_of(kept.error()));
    }
  }
  hand_overs_.journal.report.store(report_);
}

}  // namespace topo::daemon
