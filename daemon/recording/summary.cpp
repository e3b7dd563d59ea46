// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/recording/summary.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/types/bytes.hpp"

namespace topo::daemon {

namespace {

void count(const Record& record, ChannelSummary& channel) {
  switch (record.kind) {
    case RecordKind::kFromDevice:
      channel.from_device_bytes += record.bytes.size();
      break;
    case RecordKind::kToDevice:
      channel.to_device_bytes += record.bytes.size();
      break;
    case RecordKind::kOpen:
      ++channel.opens;
      break;
    case RecordKind::kGap:
      if (record.bytes.size() < 16) break;
      channel.lost_bytes += types::load_le<std::uint64_t>(record.bytes, 0);
      channel.lost_records += types::load_le<std::uint64_t>(record.bytes, 8);
      break;
    case RecordKind::kClose:
    case RecordKind::kEnd:
      break;
  }
}

}  // namespace

RecordingSummary summarise(const std::shared_ptr<const RecordingReader>& reader) {
  RecordingSummary summary;
  summary.path = reader->path();
  for (const std::string& name : reader->header().channels) summary.channels.emplace_back().name = name;
  summary.frames = reader->frames();
  summary.missing_frames = reader->missing_frames();
  types::Stamp last{types::Duration{reader->header().steady_start_ns}};
  RecordingCursor cursor(reader);
  while (true) {
    const auto record = cursor.next();
    if (!record.has_value()) {
      summary.damages.push_back(record.error().message);
      continue;
    }
    if (!record->has_value()) break;
    count(**record, summary.channels[(*record)->channel]);
    last = std::max(last, (*record)->stamp);
    summary.ended_orderly = (*record)->kind == RecordKind::kEnd;
  }
  if (reader->damage().has_value()) summary.damages.push_back(reader->damage()->message);
  summary.duration_s = types::to_seconds(last) - static_cast<double>(reader->header().steady_start_ns) * 1e-9;
  return summary;
}

std::string format_summary(const RecordingSummary& s) {
  std::string text = fmt::format("{}: {:.1f} s in {} frames, {}\n", s.path, s.duration_s, s.frames,
                                 s.ended_orderly ? "ended in order" : "broken off");
  for (const ChannelSummary& c : s.channels) {
    text += fmt::format("  {}: {} bytes from the device, {} to it, opened {} times", c.name,
                        c.from_device_bytes, c.to_device_bytes, c.opens);
    text += c.lost_records == 0 ? "\n"
                                : fmt::format("; lost {} bytes in {} pieces\n", c.lost_bytes, c.lost_records);
  }
  if (s.missing_frames > 0) text += fmt::format("  {} frames were not taken by the disk\n", s.missing_frames);
  for (const std::string& damage : s.damages) text += "  " + damage + "\n";
  return text;
}

}  // namespace topo::daemon
