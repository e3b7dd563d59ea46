// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/session/folder.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <ctime>
#include <filesystem>

namespace topo::daemon {
namespace {

constexpr std::string_view kSuffix = ".session";
constexpr std::string_view kJournal = "journal-";
constexpr std::size_t kLongest = 64;

}  // namespace

bool is_session_name(std::string_view name) {
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  };
  return !name.empty() && name.size() <= kLongest && std::all_of(name.begin(), name.end(), allowed);
}

bool is_journal_name(std::string_view name) { return name.starts_with(kJournal); }

std::string session_path(const std::string& folder, std::string_view name) {
  return fmt::format("{}/{}{}", folder, name, kSuffix);
}

types::Result<std::vector<SessionEntry>> list_sessions(const std::string& folder) {
  std::error_code error;
  std::vector<SessionEntry> sessions;
  for (auto it = std::filesystem::directory_iterator(folder, error); !error && it != std::filesystem::end(it);
       it.increment(error)) {
    std::string name = it->path().filename().string();
    if (!name.ends_with(kSuffix)) continue;
    name.resize(name.size() - kSuffix.size());
    struct stat info {};
    if (!is_session_name(name) || ::stat(it->path().c_str(), &info) != 0 || !S_ISREG(info.st_mode)) continue;
    sessions.push_back({name, it->path().string(), static_cast<std::uint64_t>(info.st_size),
                        static_cast<std::int64_t>(info.st_mtime), is_journal_name(name)});
  }
  if (error)
    return types::fail(types::Errc::kNotFound, fmt::format("{}: {}", folder, error.message()), error.value());
  std::sort(sessions.begin(), sessions.end(),
            [](const SessionEntry& a, const SessionEntry& b) { return a.name < b.name; });
  return sessions;
}

std::optional<SessionEntry> newest_journal(const std::vector<SessionEntry>& sessions) {
  const auto last = std::find_if(sessions.rbegin(), sessions.rend(), [](const auto& s) { return s.journal; });
  if (last == sessions.rend()) return std::nullopt;
  return *last;
}

std::string next_journal_name(std::int64_t seconds, const std::vector<SessionEntry>& sessions) {
  std::string name =
      fmt::format("{}{:%Y%m%dT%H%M%S}Z", kJournal, fmt::gmtime(static_cast<std::time_t>(seconds)));
  const auto last = newest_journal(sessions);
  if (!last || last->name < name) return name;
  // The clock is behind the last journal's, as on a robot without a clock battery, or the second is the same.
  constexpr std::size_t kStampEnd = kJournal.size() + 16;
  unsigned long number = 0;
  if (last->name.size() > kStampEnd + 1)
    number = std::strtoul(last->name.c_str() + kStampEnd + 1, nullptr, 10);
  return fmt::format("{}-{:05}", last->name.substr(0, kStampEnd), number + 1);
}

std::size_t remove_old_journals(const std::vector<SessionEntry>& sessions, std::size_t keep) {
  auto journals = static_cast<std::size_t>(
      std::count_if(sessions.begin(), sessions.end(), [](const auto& s) { return s.journal; }));
  std::size_t removed = 0;
  for (const SessionEntry& session : sessions) {
    if (journals <= keep) break;
    if (!session.journal) continue;
    if (remove_finished(session.path)) ++removed;
    --journals;
  }
  return removed;
}

QuotaResult keep_journals_to_quota(const std::vector<SessionEntry>& sessions, std::uint64_t quota_bytes) {
  std::vector<QuotaFile> journals;
  for (const SessionEntry& session : sessions) {
    if (session.journal) journals.push_back({session.path, session.bytes});
  }
  return keep_to_quota(journals, quota_bytes);
}

}  // namespace topo::daemon
