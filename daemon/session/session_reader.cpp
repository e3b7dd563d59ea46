// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/session/session_reader.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "daemon/mapfile/input_file.hpp"
#include "daemon/session/format.hpp"
#include "daemon/session/session_items.hpp"

namespace topo::daemon {
namespace {

using types::Errc;
using types::Result;
using types::Status;

constexpr std::size_t kMaxFileBytes = 1U << 30U;

std::string foreign_text(std::size_t bytes, std::uint32_t version) {
  if (bytes == 0) return "the file is empty";
  return version != 0 && version != kSessionVersion
             ? fmt::format("found version {}, expected {}", version, kSessionVersion)
             : std::string("the file does not begin as a session does");
}

/// Applies the records in their order; one whose content is no good counts as damaged. Returns how many of
/// them gave nothing.
std::uint64_t apply(std::span<const std::byte> file, std::uint32_t version, const RecordScan& scan,
                    SessionItems& items, LoadedSession& loaded) {
  std::uint64_t lost = 0;
  for (const FoundRecord& record : scan.records) {
    const auto rest = file.subspan(record.offset);
    const std::size_t bytes = SessionRecordHead::size_in(version) + record.head.packed_bytes;
    if (record.sealed) {
      const auto content = unpack_record(rest, record.head, version);
      if (content && !items.closed && items.take(record.head, *content)) {
        loaded.bytes += bytes;
        continue;
      }
      loaded.pieces.push_back({record.offset, bytes});
    }
    ++lost;
    if (version == kSessionVersionOld) {  // without numbers nothing can be placed behind it
      loaded.pieces = {{record.offset, file.size() - record.offset}};
      break;
    }
    // Of the last one nothing is in the file: what it would have replaced still stands.
    if (&record != &scan.records.back()) items.lose(record.head);
  }
  return lost;
}

/// True when bytes at the file's end are of a record of which nothing else is known.
bool lost_its_tail(const LoadedSession& loaded, const RecordScan& scan, std::size_t size) {
  if (loaded.closed || loaded.pieces.empty() ||
      loaded.pieces.back().offset + loaded.pieces.back().bytes != size)
    return false;
  return scan.records.empty() || scan.records.back().sealed;
}

bool only_cut(const LoadedSession& loaded) {
  return loaded.cut && loaded.pieces.size() == 1 && loaded.pieces.front().offset == loaded.bytes;
}

std::string places_text(const LoadedSession& loaded) {
  if (loaded.pieces.empty()) return "records are missing";
  const DamagedPiece& first = loaded.pieces.front();
  if (loaded.pieces.size() == 1)
    return fmt::format("{} bytes from byte {} on are damaged", first.bytes, first.offset);
  return fmt::format("{} bytes in {} places are damaged, the first at byte {}", loaded.damaged,
                     loaded.pieces.size(), first.offset);
}

std::string mended_text(const LoadedSession& loaded) {
  const Mended& m = loaded.mended;
  std::string text = fmt::format(": {} of its records are lost, {} of {} keyframes are kept",
                                 loaded.records_lost, loaded.session.keyframes.size(), m.keyframes);
  if (m.placed > 0) text += fmt::format(", {} poses follow from edges", m.placed);
  if (m.bridged > 0) text += fmt::format(", {} gaps are bridged by poses alone", m.bridged);
  return text;
}

}  // namespace

Result<LoadedSession> parse_session(std::span<const std::byte> file) {
  const DecodedSessionHeader decoded = decode_session_header(file);
  const auto foreign = [&] {
    return types::fail(Errc::kInvalidInput, foreign_text(file.size(), decoded.version));
  };
  if (decoded.whole && !decoded.header) return foreign();
  const std::uint32_t version = decoded.header ? decoded.version : kSessionVersion;
  LoadedSession loaded;
  if (decoded.header) {
    loaded.params_hash = decoded.header->params_hash;
    loaded.bytes = SessionHeader::kSize;
  }
  const RecordScan scan = scan_records(file, loaded.bytes, version);
  // Without a header, records alone tell that it is a session.
  if (!decoded.header && scan.records.empty()) return foreign();
  loaded.pieces = scan.pieces;
  loaded.cut = scan.cut;
  SessionItems items;
  loaded.records_lost = scan.missing + apply(file, version, scan, items, loaded);
  std::sort(loaded.pieces.begin(), loaded.pieces.end(),
            [](const DamagedPiece& a, const DamagedPiece& b) { return a.offset < b.offset; });
  loaded.damaged = file.size() - loaded.bytes;
  loaded.closed = items.closed;
  if (lost_its_tail(loaded, scan, file.size())) ++loaded.records_lost;
  // A kill between two records of one batch leaves a keyframe whose pose only its edges tell.
  const bool all_placed = std::all_of(items.keyframes.begin(), items.keyframes.end(),
                                      [&](const auto& k) { return items.poses.contains(k.first); });
  if (loaded.damaged == 0 && scan.missing == 0 && all_placed) {
    loaded.session = in_order(items);
  } else {
    const bool unsure = scan.missing > 0 || items.poses_void || number_behind(items.poses) < items.poses_once;
    loaded.session = mend(items, unsure, loaded.mended);
  }
  if (const Status sound = slam::check_session(loaded.session); !sound) return tl::unexpected(sound.error());
  return loaded;
}

std::string damage_text(const LoadedSession& loaded) {
  const std::size_t size = loaded.bytes + loaded.damaged;
  if (loaded.damaged == 0 && loaded.records_lost == 0)
    return loaded.closed ? std::string() : fmt::format("it ends at byte {} and was not closed", size);
  if (only_cut(loaded))
    return fmt::format("cut at byte {}, its last whole record ends at {}", size, loaded.bytes);
  if (loaded.records_lost > 0) return places_text(loaded) + mended_text(loaded);
  if (loaded.pieces.front().offset == loaded.bytes)
    return fmt::format("{} bytes behind its end are no part of it", loaded.damaged);
  return places_text(loaded) + ": nothing is lost by it";
}

Result<std::string> read_session_file(const std::string& path) { return read_file(path, kMaxFileBytes); }

Result<LoadedSession> load_session(const std::string& path) {
  const auto content = read_session_file(path);
  if (!content) return tl::unexpected(content.error());
  auto loaded = parse_session(std::as_bytes(std::span(*content)));
  if (!loaded) return types::fail(loaded.error().code, fmt::format("{}: {}", path, loaded.error().message));
  return loaded;
}

Status check_map(const LoadedSession& loaded, const std::string& path) {
  if (!loaded.session.keyframes.empty()) return {};
  const std::string damage = damage_text(loaded);
  return types::fail(Errc::kInvalidInput, fmt::format("{}: no keyframe with a pose is in it{}{}", path,
                                                      damage.empty() ? "" : ": ", damage));
}

std::string header_fault(const std::string& path) {
  const auto beginning = read_beginning(path, SessionHeader::kSize);
  if (!beginning) return beginning.error().message;
  const DecodedSessionHeader decoded = decode_session_header(std::as_bytes(std::span(*beginning)));
  if (decoded.header) return {};
  if (decoded.version != 0 && !decoded.whole)
    return "its header is damaged; what else is whole can be loaded";
  return foreign_text(beginning->size(), decoded.version);
}

}  // namespace topo::daemon
