// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "daemon/recording/channel_tap.hpp"
#include "daemon/recording/frame_writer.hpp"

namespace topo::daemon {

struct RecorderOptions {
  std::string path;
  std::vector<std::string> channels;  ///< for example front, coronal, base; at most kMaxChannels
  std::uint64_t config_hash = 0;
  std::size_t ring_bytes = 1U << 20U;  ///< per channel, a power of two: about 4 s of a scanner at 40 Hz
  types::Duration frame_period = std::chrono::seconds(1);
  types::Duration poll_period = std::chrono::milliseconds(50);  ///< period of emptying the rings
  std::uint64_t quota_bytes = 0;  ///< of this recording and those of its series (quota.hpp); 0: no limit
  /// Called on the recorder thread: for files that the quota removes, when the running recording alone
  /// exceeds it, and once when writing to the disk begins to fail, and once when it succeeds again.
  std::function<void(const std::string&)> on_warning;
};

struct RecorderStats {
  std::uint64_t file_bytes = 0;
  std::uint64_t recorded_bytes = 0;  ///< of the devices, written to the file
  std::uint64_t lost_bytes = 0;      ///< found a ring full
  std::uint64_t lost_records = 0;
  std::uint64_t frames = 0;
  std::uint64_t lost_frames = 0;  ///< could not be written
};

/// Writes the bytes from the taps to a file, on its own thread with normal priority: the threads of the
/// devices wait neither for it nor for the disk.
class Recorder {
 public:
  /// Creates the file and starts the thread. Errors name the file.
  static types::Result<std::unique_ptr<Recorder>> start(RecorderOptions options);
  /// As stop(); its error is dropped.
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// For a TappedConnector; null for a channel that is not recorded. Lives as long as the recorder.
  [[nodiscard]] io::ByteTap* tap(std::string_view channel);

  /// Blocks: empties the rings, writes the end and brings the file to the disk. To be called after the
  /// threads of the taps have ended. Returns the first error of the disk, if any. A second call has no
  /// effect.
  types::Status stop();

  /// Callable from any thread.
  [[nodiscard]] RecorderStats stats() const;

 private:
  Recorder(RecorderOptions options, FrameWriter writer);
  void run();
  void drain();
  void drain(ChannelTap& tap);
  void flush();
  void note(const types::Status& written);
  void keep_quota();

  RecorderOptions options_;
  std::vector<std::unique_ptr<ChannelTap>> taps_;

  // Used by the recorder thread only.
  FrameWriter writer_;
  std::vector<std::byte> frame_;
  std::uint32_t frame_mask_ = 0;
  std::uint64_t frame_payload_ = 0;
  types::Stamp frame_started_{};
  std::uint64_t quota_checked_at_ = 0;  ///< size of the file at which the quota is looked at again
  bool over_quota_ = false;
  bool disk_failing_ = false;
  types::Status first_error_;

  mutable std::mutex mutex_;  ///< for the recorder thread, main and readers of stats(); never a tap's thread
  std::condition_variable wake_;
  bool stopping_ = false;
  RecorderStats stats_;
  std::thread thread_;
};

}  // namespace topo::daemon
