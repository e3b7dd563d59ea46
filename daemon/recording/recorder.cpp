// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/recording/recorder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <utility>

#include "core/types/invariant.hpp"
#include "daemon/recording/quota.hpp"
#include "drivers/io/posix.hpp"

namespace topo::daemon {

using types::Errc;
using types::fail;
using types::Result;
using types::Status;

namespace {

Status check(const RecorderOptions& options) {
  const auto bad = [&](std::string_view found, std::string_view expected) {
    return fail(Errc::kInvalidInput, fmt::format("{}: found {}, expected {}", options.path, found, expected));
  };
  if (options.channels.empty() || options.channels.size() > kMaxChannels) {
    return bad(fmt::format("{} channels to record", options.channels.size()),
               fmt::format("1 to {}", kMaxChannels));
  }
  for (const std::string& name : options.channels) {
    if (name.empty() || name.size() > kMaxChannelName)
      return bad("a channel name of " + std::to_string(name.size()) + " bytes", "1 to 255");
  }
  if (!std::has_single_bit(options.ring_bytes) || options.ring_bytes < 2 * kMaxRecordBytes) {
    return bad(fmt::format("rings of {} bytes", options.ring_bytes),
               fmt::format("a power of two from {}", 2 * kMaxRecordBytes));
  }
  return {};
}

std::int64_t wall_now_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

}  // namespace

Result<std::unique_ptr<Recorder>> Recorder::start(RecorderOptions options) {
  if (auto s = check(options); !s.has_value()) return tl::unexpected(s.error());
  const RecordingHeader header{options.config_hash, wall_now_ns(),
                               io::monotonic_now().time_since_epoch().count(), options.channels};
  auto writer = FrameWriter::create(options.path, header);
  if (!writer.has_value()) return tl::unexpected(writer.error());
  std::unique_ptr<Recorder> recorder(new Recorder(std::move(options), std::move(*writer)));
  recorder->thread_ = std::thread([r = recorder.get()] { r->run(); });
  return recorder;
}

Recorder::Recorder(RecorderOptions options, FrameWriter writer)
    : options_(std::move(options)), writer_(std::move(writer)) {
  for (std::size_t i = 0; i < options_.channels.size(); ++i) {
    taps_.push_back(std::make_unique<ChannelTap>(static_cast<std::uint8_t>(i), options_.ring_bytes));
  }
  frame_.reserve(kMaxFrameBytes);
}

Recorder::~Recorder() {
  if (auto s = stop(); !s.has_value()) return;  // already reported through on_warning
}

io::ByteTap* Recorder::tap(std::string_view channel) {
  const auto found = std::find(options_.channels.begin(), options_.channels.end(), channel);
  return found == options_.channels.end()
             ? nullptr
             : taps_[static_cast<std::size_t>(found - options_.channels.begin())].get();
}

Status Recorder::stop() {
  if (!thread_.joinable()) return {};
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  wake_.notify_one();
  thread_.join();
  return first_error_;
}

/// Looked at anew each time that the recording grew by a hundredth of the quota.
void Recorder::keep_quota() {
  const std::uint64_t quota = options_.quota_bytes;
  if (quota == 0 || writer_.file_bytes() < quota_checked_at_) return;
  quota_checked_at_ = writer_.file_bytes() + quota / 100 + 1;
  const QuotaResult kept = keep_to_quota(recordings_beside(options_.path), quota);
  const auto tell = [this](const std::string& text) {
    if (options_.on_warning) options_.on_warning(text);
  };
  constexpr std::uint64_t kMega = 1'000'000;
  if (kept.removed > 0) {
    tell(fmt::format("{} old recordings of {} MB are removed: record.quota_mb is {}", kept.removed,
                     kept.removed_bytes / kMega, quota / kMega));
  }
  if (kept.left_bytes > quota && !std::exchange(over_quota_, true)) {
    tell(fmt::format("{}: goes on beyond record.quota_mb = {}: no finished recording is left to be removed",
                     options_.path, quota / kMega));
  }
}

void Recorder::run() {
  keep_quota();
  for (bool stopping = false; !stopping;) {
    {
      std::unique_lock lock(mutex_);
      stopping = wake_.wait_for(lock, options_.poll_period, [this] { return stopping_; });
    }
    drain();
    if (!frame_.empty() && io::monotonic_now() - frame_started_ >= options_.frame_period) flush();
  }
  const auto end = encode_record_head({0, RecordKind::kEnd, 0, io::monotonic_now()});
  frame_.insert(frame_.end(), end.begin(), end.end());
  flush();
  // Covers only the frames that were written; a success does not include lost ones.
  if (const Status synced = writer_.sync(); !synced.has_value()) note(synced);
}

void Recorder::drain() {
  for (const auto& tap : taps_) drain(*tap);
  std::uint64_t bytes = 0, records = 0;
  for (const auto& tap : taps_) {
    bytes += tap->lost_bytes();
    records += tap->lost_records();
  }
  const std::lock_guard lock(mutex_);
  stats_.lost_bytes = bytes;
  stats_.lost_records = records;
}

void Recorder::drain(ChannelTap& tap) {
  // Only the bytes present at the start, so that a busy channel does not delay the others.
  for (std::size_t left = tap.ring().size(); left >= RecordHead::kSize;) {
    std::array<std::byte, RecordHead::kSize> bytes{};
    tap.ring().peek(bytes);
    const auto head = decode_record_head(bytes);
    types::require(head.has_value(), "daemon::Recorder: a record head that its own tap did not write");
    const std::size_t n = RecordHead::kSize + head->length;
    if (frame_.size() + n > kFrameTarget) flush();
    if (frame_.empty()) frame_started_ = io::monotonic_now();
    frame_.resize(frame_.size() + n);
    tap.ring().peek(std::span(frame_).last(n));
    tap.ring().drop(n);
    frame_mask_ |= 1U << tap.channel();
    if (head->kind != RecordKind::kGap) frame_payload_ += head->length;
    left -= n;
  }
}

void Recorder::flush() {
  const Status written = writer_.write(frame_, frame_mask_);
  note(written);
  {
    const std::lock_guard lock(mutex_);
    stats_.file_bytes = writer_.file_bytes();
    if (written.has_value()) {
      ++stats_.frames;
      stats_.recorded_bytes += frame_payload_;
    } else {
      ++stats_.lost_frames;
    }
  }
  frame_.clear();
  frame_mask_ = 0;
  frame_payload_ = 0;
  keep_quota();
}

void Recorder::note(const Status& written) {
  if (written.has_value() != disk_failing_) return;
  disk_failing_ = !written.has_value();
  if (!written.has_value() && first_error_.has_value()) first_error_ = written;
  if (!options_.on_warning) return;
  if (disk_failing_) {
    options_.on_warning(written.error().message + "; what comes meanwhile is lost from the recording");
  } else {
    options_.on_warning(options_.path + ": the disk takes the recording again");
  }
}

RecorderStats Recorder::stats() const {
  const std::lock_guard lock(mutex_);
  return stats_;
}

}  // namespace topo::daemon
