// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/session/record_scan.hpp"

#include <algorithm>

namespace topo::daemon {
namespace {

using Bytes = std::span<const std::byte>;

void add_piece(std::vector<DamagedPiece>& pieces, std::size_t offset, std::size_t bytes) {
  if (bytes == 0) return;
  if (!pieces.empty() && pieces.back().offset + pieces.back().bytes == offset)
    pieces.back().bytes += bytes;
  else
    pieces.push_back({offset, bytes});
}

std::size_t end_of(const FoundRecord& record, std::uint32_t version) {
  return record.offset + SessionRecordHead::size_in(version) + record.head.packed_bytes;
}

/// Keeps one record of each number, a sealed one before others; further copies become pieces.
void keep_each_once(RecordScan& scan, std::uint32_t version) {
  std::stable_sort(scan.records.begin(), scan.records.end(), [](const FoundRecord& a, const FoundRecord& b) {
    return a.head.number != b.head.number ? a.head.number < b.head.number : a.sealed && !b.sealed;
  });
  std::vector<FoundRecord> once;
  for (const FoundRecord& record : scan.records) {
    if (once.empty() || once.back().head.number != record.head.number)
      once.push_back(record);
    else if (record.sealed)
      scan.pieces.push_back({record.offset, end_of(record, version) - record.offset});
  }
  scan.records = std::move(once);
  std::sort(scan.pieces.begin(), scan.pieces.end(),
            [](const DamagedPiece& a, const DamagedPiece& b) { return a.offset < b.offset; });
  if (!scan.records.empty())
    scan.missing = std::uint64_t{scan.records.back().head.number} + 1 - scan.records.size();
}

RecordScan scan_unnumbered(Bytes file, std::size_t begin) {
  RecordScan scan;
  std::size_t at = begin;
  while (const auto head = decode_session_record_head(file.subspan(at), kSessionVersionOld)) {
    FoundRecord record{*head, at, is_sealed(file.subspan(at), *head, kSessionVersionOld)};
    if (!record.sealed) break;
    record.head.number = static_cast<std::uint32_t>(scan.records.size());
    scan.records.push_back(record);
    at = end_of(record, kSessionVersionOld);
  }
  add_piece(scan.pieces, at, file.size() - at);
  return scan;
}

}  // namespace

RecordScan scan_records(Bytes file, std::size_t begin, std::uint32_t version) {
  RecordScan scan;
  if (version == kSessionVersionOld) {
    scan = scan_unnumbered(file, begin);
  } else {
    for (std::size_t at = begin; at < file.size();) {
      const auto head = decode_session_record_head(file.subspan(at), version);
      if (!head) {
        const std::size_t next = find_record_magic(file, at + 1);
        add_piece(scan.pieces, at, next - at);
        at = next;
        continue;
      }
      const FoundRecord record{*head, at, is_sealed(file.subspan(at), *head, version)};
      scan.records.push_back(record);
      // The length of a damaged record may reach over whole ones, when bytes were lost or came in.
      const std::size_t next =
          record.sealed ? end_of(record, version) : find_record_magic(file, record.offset + 1);
      if (!record.sealed) add_piece(scan.pieces, at, next - at);
      at = next;
    }
    keep_each_once(scan, version);
  }
  if (!scan.pieces.empty()) {
    const DamagedPiece& last = scan.pieces.back();
    scan.cut = last.offset + last.bytes == file.size() && is_cut(file.subspan(last.offset), version);
  }
  return scan;
}

}  // namespace topo::daemon
