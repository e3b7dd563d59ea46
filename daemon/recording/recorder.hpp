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
  std::vector<std::string> channels;  ///< such as front, coronal, base; at most kMaxChannels
  std::uint64_t config_hash = 0;
  std::size_t ring_bytes = 1U << 20U;  ///< per channel, a power of two: about 4 s of a scanner at 40 Hz
  types::Duration frame_period = std::chrono::seconds(1);
  types::Duration poll_period = std::chrono::milliseconds(50);  ///< how often the rings are emptied
  /// Called on the recorder thread, once when the disk stops taking frames and once when it takes them again.
  std::function<void(const std::string&)> on_warning;
};

struct RecorderStats {
  std::uint64_t file_bytes = 0;
  std::uint64_t recorded_bytes = 0;  ///< of the devices, handed to the file
  std::uint64_t lost_bytes = 0;      ///< found no room in a ring
  std::uint64_t lost_records = 0;
  std::uint64_t frames = 0;
  std::uint64_t lost_frames = 0;  ///< not taken by the disk
};

/// Writes what the taps heard to a file, on a thread of its own with normal priority: the threads that talk
/// to the devices never wait for it, nor for the disk.
class Recorder {
 public:
  /// Creates the file and starts the thread. Errors name the file.
  static types::Result<std::unique_ptr<Recorder>> start(RecorderOptions options);
  /// As stop(), with its error dropped.
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// For a TappedConnector; null for a channel that is not recorded. Lives as long as the recorder.
  [[nodiscard]] io::ByteTap* tap(std::string_view channel);

  /// Blocks: empties the rings, writes the end and brings the file to the disk. To be called after the
  /// threads of the taps have ended. The first error of the disk, if there was one. A second call does
  /// nothing.
  types::Status stop();

  /// Any thread.
  [[nodiscard]] RecorderStats stats() const;

 private:
  Recorder(RecorderOptions options, FrameWriter writer);
  void run();
  void drain();
  void drain(ChannelTap& tap);
  void flush();
  void note(const types::Status& written);

  RecorderOptions options_;
  std::vector<std::unique_ptr<ChannelTap>> taps_;

  // The recorder thread's own.
  FrameWriter writer_;
  std::vector<std::byte> frame_;
  std::uint32_t frame_mask_ = 0;
  std::uint64_t frame_payload_ = 0;
  types::Stamp frame_started_{};
  bool disk_failing_ = false;
  types::Status first_error_;

  mutable std::mutex mutex_;  ///< recorder thread, main and reporters; never a tap's thread
  std::condition_variable wake_;
  bool stopping_ = false;
  RecorderStats stats_;
  std::thread thread_;
};

}  // namespace topo::daemon
