// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "core/types/result.hpp"
#include "drivers/io/unique_fd.hpp"

namespace topo::bench {

/// The finished runs of a table in a file, one JSON object a line: {"run": what was asked for, "report": what
/// came out}, or "crashed" in place of the report, and why. A line is appended whole by one write(2);
/// whatever kills the program, what is in the file stays.
class RunLog {
 public:
  /// Opens or makes the file, and locks it against other programs (kBusy). What stands behind the last line
  /// feed is a torn line: it is cut off. Lines that are no runs are left alone and counted.
  static types::Result<RunLog> open(const std::filesystem::path& file);

  /// The report of a run; null when it is not there. `run`: json_of(RunKey). Of several lines for one run the
  /// last.
  [[nodiscard]] const nlohmann::json* find(const nlohmann::json& run) const;
  /// Why a run left no report; null when it did, or was not tried.
  [[nodiscard]] const std::string* find_crash(const nlohmann::json& run) const;
  types::Status append(const nlohmann::json& run, nlohmann::json report);
  types::Status append_crash(const nlohmann::json& run, const std::string& why);

  [[nodiscard]] std::size_t size() const { return reports_.size(); }
  /// The keys' `program` of all runs that have a report.
  [[nodiscard]] const std::set<std::string>& programs() const { return programs_; }
  [[nodiscard]] std::size_t strange_lines() const { return strange_lines_; }

 private:
  RunLog(std::filesystem::path file, io::UniqueFd fd) : file_(std::move(file)), fd_(std::move(fd)) {}
  void take_line(const std::string& line);
  void take_report(const nlohmann::json& run, nlohmann::json report);
  types::Status write_line(const nlohmann::json& entry);

  std::filesystem::path file_;
  io::UniqueFd fd_;
  std::map<std::string, nlohmann::json> reports_;  ///< by the text of the run
  std::map<std::string, std::string> crashes_;     ///< the same
  std::set<std::string> programs_;
  std::size_t strange_lines_ = 0;
};

}  // namespace topo::bench
