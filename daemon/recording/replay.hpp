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
  /// Device bytes recorded after the n-th host byte wait until the connection has written as many, but at
  /// most this long after their time; after such a time-out nothing waits any more on that connection.
  types::Duration gate_timeout = std::chrono::seconds(1);
  /// Waiting applies only in this time after the device was opened: the handshake, in which replies follow
  /// requests. Later the connection's commands may differ from the recorded ones.
  types::Duration gate_span = std::chrono::seconds(10);
  /// Each channel has a clock of its own, in the recorded time, which goes on to the next record at once: for
  /// work that wants the recording's values and not its pace.
  bool at_once = false;
};

/// Replays a recording in place of the devices, in real time on the host's steady clock (or at once,
/// ReplayOptions::at_once): the same connections
/// and mapper run on it. Its stamps are the recorded ones plus one offset for all channels, which the first
/// connect sets.
class Replay {
 public:
  /// Errors as in RecordingReader::open().
  static types::Result<std::shared_ptr<Replay>> open(const std::string& path, ReplayOptions options = {});

  /// Plays one channel. kInvalidInput when the recording has no such channel (the message lists its
  /// channels). `has_baud`: result of the streams' has_baud(), to be set as for the recorded transport. One
  /// thread uses a connector and its streams; several connectors may be used at once. A channel is played
  /// once.
  static types::Result<std::unique_ptr<io::Connector>> connector(const std::shared_ptr<Replay>& replay,
                                                                 std::string_view channel, bool has_baud);

  [[nodiscard]] const RecordingReader& recording() const { return *reader_; }

  /// Callable from any thread. True when there is a connector and all have reached the end of their channels.
  [[nodiscard]] bool finished() const {
    const int made = connectors_.load();
    return made > 0 && ended_.load() >= made;
  }
  /// Callable from any thread. Number of connections on which device bytes continued before the connection
  /// had written as many bytes as recorded.
  [[nodiscard]] int gates_released() const { return gates_released_.load(); }

 private:
  friend class ReplayChannel;
  Replay(std::shared_ptr<const RecordingReader> reader, ReplayOptions options)
      : reader_(std::move(reader)), options_(options) {}
  /// The offset added to a recorded stamp; the first call sets it.
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
