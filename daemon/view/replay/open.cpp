// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/view/replay/open.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include "daemon/mapfile/input_file.hpp"
#include "daemon/recording/recording_reader.hpp"
#include "daemon/session/folder.hpp"
#include "daemon/session/mission_log_file.hpp"
#include "daemon/view/replay/team_news.hpp"

namespace topo::daemon {
namespace {

using types::Errc;
using types::fail;
using types::Result;

constexpr std::size_t kMaxLogBytes = 1U << 28U;  // two days at 1 Hz with a team
// The first lines of a log are written with the first journal, or before.
constexpr std::int64_t kLogLate_s = 5;

/// The time in a file's name: "...20260102T030405Z...".
std::optional<std::int64_t> begun_at(const std::string& name) {
  constexpr std::size_t kDate = 16;
  for (std::size_t at = 0; at + kDate <= name.size(); ++at) {
    const std::string_view d = std::string_view(name).substr(at, kDate);
    const auto seconds =
        seconds_of(fmt::format("{}-{}-{}T{}:{}:{}", d.substr(0, 4), d.substr(4, 2), d.substr(6, 2),
                               d.substr(9, 2), d.substr(11, 2), d.substr(13)));
    if (d[8] == 'T' && seconds) return seconds;
  }
  return {};
}

std::int64_t written_at(const std::string& path) {
  struct stat info {};
  return ::stat(path.c_str(), &info) == 0 ? info.st_mtim.tv_sec : 0;
}

}  // namespace

bool is_recording(const std::string& path) {
  std::error_code failed;
  return std::filesystem::is_regular_file(path, failed) && RecordingReader::open(path).has_value();
}

Result<std::string> find_session(const std::string& path) {
  std::error_code failed;
  if (!std::filesystem::is_directory(path, failed)) {
    if (!std::filesystem::exists(path, failed))
      return fail(Errc::kNotFound, fmt::format("{}: there is no such session, folder or recording", path));
    return path;
  }
  const auto sessions = list_sessions(path);
  if (!sessions) return tl::unexpected(sessions.error());
  const auto newest = newest_journal(*sessions);
  if (!newest)
    return fail(Errc::kNotFound, fmt::format("{}: found no journal-DATE.session in this folder", path));
  return newest->path;
}

Result<Played> load_played(const std::string& session) {
  auto map = load_history(session);
  if (!map) return tl::unexpected(map.error());
  const std::filesystem::path path(session);
  Played played{path.stem().string(), std::move(*map), {}, {}};
  const auto named = is_journal_name(played.name) ? begun_at(played.name) : std::nullopt;
  const std::int64_t until_s = named ? *named + kLogLate_s : written_at(session);
  const std::string folder = path.has_parent_path() ? path.parent_path().string() : ".";
  for (const QuotaFile& log : mission_logs(folder)) {
    const auto begun_s = begun_at(std::filesystem::path(log.path).filename().string());
    if (begun_s && *begun_s <= until_s) played.log = log.path;
  }
  if (!played.log.empty()) {
    const auto text = read_file(played.log, kMaxLogBytes);
    if (!text) return tl::unexpected(text.error());
    Story of_log = of_map(parse_story(*text), named ? named : std::optional(until_s));
    played.story = with_team_news(with_all_keyframes(std::move(of_log), played.map));
  }
  if (played.story.states.empty()) {
    played.log.clear();
    played.story = story_of(played.map);
  }
  return played;
}

}  // namespace topo::daemon
