// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/recording/replay.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <time.h>

#include <algorithm>
#include <cstring>

#include "drivers/io/posix.hpp"

namespace topo::daemon {

using types::Duration;
using types::Errc;
using types::fail;
using types::Result;
using types::Stamp;
using types::Status;

/// One channel's records with their times on the host's clock. Used by one thread.
class ReplayChannel {
 public:
  ReplayChannel(std::shared_ptr<Replay> replay, std::size_t channel, std::string name)
      : replay_(std::move(replay)), cursor_(replay_->reader_, channel), name_(std::move(name)) {
    replay_->connectors_.fetch_add(1);
    if (const Record* first = options().at_once ? front() : nullptr) clock_ = first->stamp;
  }

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const ReplayOptions& options() const { return replay_->options_; }
  void count_released_gate() { replay_->gates_released_.fetch_add(1); }

  /// The next record, or null at the end of the recording.
  const Record* front() {
    while (!front_.has_value() && !ended_) {
      auto record = cursor_.next();
      if (!record.has_value()) continue;  // a damaged frame: its bytes are missing in the replay
      front_ = *record;
      if (!front_.has_value() || front_->kind == RecordKind::kEnd) end();
    }
    return front_.has_value() ? &*front_ : nullptr;
  }
  void pop() { front_.reset(); }
  [[nodiscard]] Stamp due(const Record& record) {
    return options().at_once ? record.stamp : record.stamp + replay_->offset(io::monotonic_now());
  }
  [[nodiscard]] Stamp now() const { return options().at_once ? clock_ : io::monotonic_now(); }
  void sleep_until(Stamp when) {
    if (options().at_once)
      clock_ = std::max(clock_, when);
    else
      io::sleep_until(when);
  }

 private:
  void end() {
    front_.reset();
    ended_ = true;
    replay_->ended_.fetch_add(1);
  }

  std::shared_ptr<Replay> replay_;
  RecordingCursor cursor_;
  std::string name_;
  std::optional<Record> front_;
  bool ended_ = false;
  Stamp clock_{};  ///< of a replay at once
};

namespace {

/// One recorded connection, from opening to closing.
class ReplayStream final : public io::ByteStream {
 public:
  ReplayStream(std::shared_ptr<ReplayChannel> channel, Stamp opened, bool has_baud)
      : channel_(std::move(channel)),
        gate_until_(opened + channel_->options().gate_span),
        has_baud_(has_baud) {}

  Result<io::ReadResult> read(std::span<std::byte> buffer, Duration timeout) override {
    const Stamp deadline = now() + timeout;
    skip_host_bytes();
    const Record* record = channel_->front();
    if (record == nullptr) return closed("the recording is at its end");
    const Stamp due = channel_->due(*record);
    if (record->kind != RecordKind::kFromDevice) {
      if (!wait(due, deadline)) return io::ReadResult{0, now()};
      return closed("the recorded connection ended here");
    }
    if (gated(due)) {
      // Only this thread can write, so the missing bytes cannot arrive while it waits here.
      if (!wait(due + channel_->options().gate_timeout, deadline)) return io::ReadResult{0, now()};
      gate_until_ = Stamp{};
      channel_->count_released_gate();
    }
    if (!wait(due, deadline)) return io::ReadResult{0, now()};
    return deliver(*record, buffer, due);
  }

  Status write(std::span<const std::byte> bytes, Duration) override {
    written_ += bytes.size();
    last_write_ = now();
    return {};
  }
  Status set_baud(int) override { return {}; }
  [[nodiscard]] bool has_baud() const override { return has_baud_; }
  [[nodiscard]] Stamp now() const override { return channel_->now(); }

 private:
  tl::unexpected<types::Error> closed(std::string_view why) const {
    return fail(Errc::kClosed, fmt::format("{}: {}", channel_->name(), why));
  }

  void skip_host_bytes() {
    for (const Record* r = channel_->front();
         r != nullptr && (r->kind == RecordKind::kToDevice || r->kind == RecordKind::kGap);
         r = channel_->front()) {
      if (r->kind == RecordKind::kToDevice) {
        recorded_writes_ += r->bytes.size();
        answer_ = true;
      }
      channel_->pop();
    }
  }

  [[nodiscard]] bool gated(Stamp due) const { return due < gate_until_ && written_ < recorded_writes_; }

  /// Sleeps until `when`, at most until `deadline`; true when `when` has been reached.
  bool wait(Stamp when, Stamp deadline) const {
    if (now() < when) channel_->sleep_until(std::min(when, deadline));
    return now() >= when;
  }

  io::ReadResult deliver(const Record& record, std::span<std::byte> buffer, Stamp due) {
    const std::size_t n = std::min(buffer.size(), record.bytes.size() - taken_);
    std::memcpy(buffer.data(), record.bytes.data() + taken_, n);
    taken_ += n;
    // A reply in the handshake is never older than its request; otherwise round trips would be negative.
    const Stamp stamp = answer_ && due < gate_until_ ? std::max(due, last_write_) : due;
    if (taken_ == record.bytes.size()) {
      taken_ = 0;
      answer_ = false;
      channel_->pop();
    }
    return {n, stamp};
  }

  std::shared_ptr<ReplayChannel> channel_;
  Stamp gate_until_;
  bool has_baud_;
  bool answer_ = false;  ///< the front record followed host bytes
  std::size_t taken_ = 0;
  std::uint64_t written_ = 0;
  std::uint64_t recorded_writes_ = 0;
  Stamp last_write_{};
};

class ReplayConnector final : public io::Connector {
 public:
  ReplayConnector(std::shared_ptr<ReplayChannel> channel, bool has_baud)
      : channel_(std::move(channel)), has_baud_(has_baud) {}

  Result<std::unique_ptr<io::ByteStream>> connect(Duration timeout) override {
    const Stamp deadline = now() + timeout;
    const Record* record = channel_->front();
    while (record != nullptr && record->kind != RecordKind::kOpen) {
      channel_->pop();
      record = channel_->front();
    }
    if (record == nullptr) return fail(Errc::kClosed, fmt::format("{}: the recording is at its end", name()));
    const Stamp due = channel_->due(*record);
    if (now() < due) channel_->sleep_until(std::min(due, deadline));
    if (now() < due) return fail(Errc::kTimeout, fmt::format("{}: not opened yet in the recording", name()));
    channel_->pop();
    return std::make_unique<ReplayStream>(channel_, due, has_baud_);
  }
  [[nodiscard]] std::string_view name() const override { return channel_->name(); }
  [[nodiscard]] Stamp now() const override { return channel_->now(); }
  void pause(Duration duration) override { channel_->sleep_until(now() + duration); }

 private:
  std::shared_ptr<ReplayChannel> channel_;
  bool has_baud_;
};

}  // namespace

Result<std::shared_ptr<Replay>> Replay::open(const std::string& path, ReplayOptions options) {
  auto reader = RecordingReader::open(path);
  if (!reader.has_value()) return tl::unexpected(reader.error());
  return std::shared_ptr<Replay>(new Replay(std::move(*reader), options));
}

Result<std::unique_ptr<io::Connector>> Replay::connector(const std::shared_ptr<Replay>& replay,
                                                         std::string_view channel, bool has_baud) {
  const RecordingReader& reader = replay->recording();
  const auto index = reader.channel(channel);
  if (!index.has_value()) {
    return fail(Errc::kInvalidInput, fmt::format("{}: found channels {}, expected {}", reader.path(),
                                                 fmt::join(reader.header().channels, ", "), channel));
  }
  auto playing =
      std::make_shared<ReplayChannel>(replay, *index, fmt::format("replay:{}:{}", reader.path(), channel));
  return std::make_unique<ReplayConnector>(std::move(playing), has_baud);
}

Duration Replay::offset(Stamp now) {
  std::int64_t known = offset_ns_.load();
  if (known == kNoOffset) {
    const std::int64_t mine = now.time_since_epoch().count() - reader_->header().steady_start_ns;
    known = offset_ns_.compare_exchange_strong(known, mine) ? mine : known;
  }
  return Duration{known};
}

}  // namespace topo::daemon
