// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/session/mission_log_file.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <ctime>
#include <filesystem>

namespace topo::daemon {
namespace {

constexpr std::string_view kBegin = "log-", kEnd = ".jsonl";

}  // namespace

types::Result<MissionLogFile> MissionLogFile::create(const std::string& folder, std::int64_t seconds) {
  constexpr int kTries = 1000;
  const std::string stem =
      fmt::format("{}/{}{:%Y%m%dT%H%M%S}Z", folder, kBegin, fmt::gmtime(static_cast<std::time_t>(seconds)));
  for (int number = 0;; ++number) {
    auto file = AppendFile::create(
        number == 0 ? fmt::format("{}{}", stem, kEnd) : fmt::format("{}-{:03}{}", stem, number, kEnd),
        "mission log");
    if (file) return MissionLogFile(std::move(*file));
    if (file.error().sys_errno != EEXIST || number == kTries) return tl::unexpected(file.error());
  }
}

types::Status MissionLogFile::append(std::string_view lines) {
  return file_.append(std::as_bytes(std::span(lines)));
}

std::vector<QuotaFile> mission_logs(const std::string& folder) {
  std::vector<QuotaFile> logs;
  std::error_code error;
  for (auto it = std::filesystem::directory_iterator(folder, error); !error && it != std::filesystem::end(it);
       it.increment(error)) {
    std::error_code gone;  // another process may remove the file meanwhile
    const std::string name = it->path().filename().string();
    if (!name.starts_with(kBegin) || !name.ends_with(kEnd) || !it->is_regular_file(gone)) continue;
    const std::uintmax_t bytes = it->file_size(gone);
    if (!gone) logs.push_back({it->path().string(), bytes});
  }
  std::sort(logs.begin(), logs.end(), [](const QuotaFile& a, const QuotaFile& b) { return a.path < b.path; });
  return logs;
}

}  // namespace topo::daemon
