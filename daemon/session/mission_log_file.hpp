// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/types/result.hpp"
#include "daemon/recording/quota.hpp"
#include "daemon/session/append_file.hpp"

namespace topo::daemon {

/// The mission log of one run of the daemon, log-YYYYMMDDTHHMMSSZ.jsonl: lines of JSON, for people and for
/// programs (app/mission_log.hpp says what they hold). A killed daemon leaves whole lines.
class MissionLogFile {
 public:
  /// Creates the file; `seconds` since 1970. A name that exists gets a number behind it.
  static types::Result<MissionLogFile> create(const std::string& folder, std::int64_t seconds);

  /// Appends lines, each with its line feed. On failure the file is unchanged.
  types::Status append(std::string_view lines);

  [[nodiscard]] const std::string& path() const { return file_.path(); }

 private:
  explicit MissionLogFile(AppendFile file) : file_(std::move(file)) {}
  AppendFile file_;
};

/// Mission logs of a folder, the oldest first by their names.
[[nodiscard]] std::vector<QuotaFile> mission_logs(const std::string& folder);

}  // namespace topo::daemon
