// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/session/map_history.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/slam/session.hpp"
#include "daemon/session/record_scan.hpp"
#include "daemon/session/session_items.hpp"
#include "daemon/session/session_reader.hpp"

namespace topo::daemon {

/// Empty unless every record is whole and gives what the session has: numbers in a mended session are others.
std::vector<MapHistory::Written> MapHistory::written_in(std::span<const std::byte> file,
                                                        std::size_t keyframes) {
  const DecodedSessionHeader decoded = decode_session_header(file);
  if (!decoded.header || decoded.version == kSessionVersionOld) return {};
  const RecordScan scan = scan_records(file, SessionHeader::kSize, decoded.version);
  if (scan.missing > 0) return {};
  SessionItems items;
  std::vector<Written> written;
  for (const FoundRecord& record : scan.records) {
    if (!record.sealed || !record.head.first) return {};
    const auto content = unpack_record(file.subspan(record.offset), record.head, decoded.version);
    if (!content || !items.take(record.head, *content)) return {};
    if (record.head.kind != SessionRecord::kPoses) continue;
    Written more{items.keyframes.size(), *record.head.first, {}};
    for (auto at = items.poses.lower_bound(more.first); at != items.poses.end(); ++at)
      more.poses.push_back(at->second);
    if (!std::ranges::all_of(more.poses, &slam::is_in_reach)) return {};
    written.push_back(std::move(more));
  }
  const bool same = items.keyframes.size() == keyframes && number_behind(items.keyframes) == keyframes;
  return same ? written : std::vector<Written>{};
}

std::vector<types::Se2> MapHistory::poses(std::size_t count) const {
  count = std::min(count, keyframes_.size());
  std::vector<types::Se2> poses(count);
  std::vector<bool> known(count, false);
  for (const Written& written : written_) {
    const bool later = written.keyframes > count;
    const std::size_t end = std::min(count, written.first + written.poses.size());
    for (std::size_t i = written.first; i < end; ++i) {
      if (later && known[i]) continue;
      poses[i] = written.poses[i - written.first];
      known[i] = true;
    }
  }
  return poses;
}

types::Result<MapHistory> parse_history(std::span<const std::byte> file) {
  auto loaded = parse_session(file);
  if (!loaded) return tl::unexpected(loaded.error());
  MapHistory history;
  const std::size_t keyframes = loaded->session.keyframes.size();
  history.written_ = MapHistory::written_in(file, keyframes);
  history.written_.push_back({keyframes, 0, std::move(loaded->session.poses)});
  history.keyframes_ = std::move(loaded->session.keyframes);
  return history;
}

types::Result<MapHistory> load_history(const std::string& path) {
  const auto content = read_session_file(path);
  if (!content) return tl::unexpected(content.error());
  auto history = parse_history(std::as_bytes(std::span(*content)));
  if (!history)
    return types::fail(history.error().code, fmt::format("{}: {}", path, history.error().message));
  return history;
}

}  // namespace topo::daemon
