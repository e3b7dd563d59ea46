// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <string_view>

#include "daemon/recording/recording_reader.hpp"
#include "drivers/io/byte_stream.hpp"

namespace topo::daemon {

struct ReplayOptions {
  /// Device bytes that came after the n-th host byte wait until the session wrote as many, but no longer than
  /// this after their time; once that happened, nothing waits any more on that connection.
  types::Duration gate_timeout = std::chrono::seconds(1);
  /// Only in this time after the device was opened: it holds the handshake, in which answers follow
  /// questions. Later the session's commands need not be the recorded ones.
  types::Duration gate_span = std::chrono::seconds(10);
};

/// A recording that plays as devices, in its own pace on the host's steady clock: the same sessions and
/// mapper run over it. Its stamps are the recorded ones moved by one offset for all channels, which the first
/// connect sets.
class Replay {
 public:
  /// Errors as RecordingReader::open.
  static types::Result<std::shared_ptr<Replay>> open(const std::string& path, ReplayOptions options = {});

  /// Plays one channel. kInvalidInput when the recording has no such channel (the message names those it
  /// has). `has_baud`: what the streams say of themselves; as the device's transport was when it was
  /// recorded. One thread uses a connector and its streams; several connectors may be used at once. A channel
  /// is played once.
  static types::Result<std::unique_ptr<io::Connector>> connector(const std::shared_ptr<Replay>& replay,
                                                                 std::string_view channel, bool has_baud);

  [[nodiscard]] const RecordingReader& recording() const { return *reader_; }

  /// Any thread. True when every connector has come to the end of its channel (and there is one).
  [[nodiscard]] bool finished() const {
    const int made = connectors_.load();
    return made > 0 && ended_.load() >= made;
  }
  /// Any thread. Connections whose device bytes went on without the session having written as many as
  /// recorded.
  [[nodiscard]] int gates_released() const { return gates_released_.load(); }

 private:
  friend class ReplayChannel;
  Replay(std::shared_ptr<const RecordingReader> reader, ReplayOptions options)
      : reader_(std::move(reader)), options_(options) {}
  /// What is added to a recorded stamp; the first caller fixes it.
  types::Duration offset(types::Stamp now);

  std::shared_ptr<const RecordingReader> reader_;
  ReplayOptions options_;
  std::atomic<std::int64_t> offset_ns_{kNoOffset};
  std::atomic<int> connectors_{0};
  std::atomic<int> ended_{0};
  std::atomic<int> gates_released_{0};
  static constexpr std::int64_t kNoOffset = INT64_MIN;
};

}  // namespace topo::daemon
