// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "daemon/recording/recording_reader.hpp"

namespace topo::daemon {

struct ChannelSummary {
  std::string name;
  std::uint64_t from_device_bytes = 0;
  std::uint64_t to_device_bytes = 0;
  std::uint64_t opens = 0;
  std::uint64_t lost_bytes = 0;  ///< according to the gap records
  std::uint64_t lost_records = 0;
};

struct RecordingSummary {
  std::string path;
  std::vector<ChannelSummary> channels;
  double duration_s = 0.0;  ///< from the start to the last record
  std::uint64_t frames = 0;
  std::uint64_t missing_frames = 0;  ///< could not be written while recording
  std::vector<std::string> damages;  ///< unreadable frames, and the position where the file breaks off
  bool ended_orderly = false;        ///< the recorder was stopped, not killed
};

/// Reads the whole recording once; damage is reported in the summary.
[[nodiscard]] RecordingSummary summarise(const std::shared_ptr<const RecordingReader>& reader);

/// A few lines for users.
[[nodiscard]] std::string format_summary(const RecordingSummary& summary);

}  // namespace topo::daemon
