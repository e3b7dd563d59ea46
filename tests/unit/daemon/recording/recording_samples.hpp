// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "daemon/recording/frame_writer.hpp"
#include "drivers/io/posix.hpp"

namespace topo::daemon::testing {

using namespace std::chrono_literals;

inline std::span<const std::byte> bytes_of(std::string_view text) { return std::as_bytes(std::span(text)); }
inline std::string text_of(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// A recording made by hand, with stamps of our choice: milliseconds after its start.
class HandMade {
 public:
  static constexpr std::int64_t kStart_ns = 5'000'000'000;

  HandMade(const std::string& path, std::vector<std::string> channels)
      : writer_(FrameWriter::create(path, {77, 1'000, kStart_ns, std::move(channels)})) {}

  HandMade& add(std::uint8_t channel, RecordKind kind, int ms, std::string_view text = {}) {
    return add_at(channel, kind, std::chrono::milliseconds(ms), text);
  }
  HandMade& add_at(std::uint8_t channel, RecordKind kind, types::Duration after_start,
                   std::string_view text) {
    const types::Stamp stamp{types::Duration{kStart_ns} + after_start};
    const auto head = encode_record_head({channel, kind, static_cast<std::uint32_t>(text.size()), stamp});
    records_.insert(records_.end(), head.begin(), head.end());
    const auto body = bytes_of(text);
    records_.insert(records_.end(), body.begin(), body.end());
    mask_ |= 1U << channel;
    return *this;
  }
  /// Ends a frame; false when it could not be written.
  bool frame() {
    const bool ok = writer_.has_value() && writer_->write(records_, mask_).has_value();
    records_.clear();
    mask_ = 0;
    return ok;
  }

 private:
  types::Result<FrameWriter> writer_;
  std::vector<std::byte> records_;
  std::uint32_t mask_ = 0;
};

/// True as soon as `condition` holds; false after ten seconds.
inline bool wait_for(const std::function<bool()>& condition) {
  const auto deadline = io::monotonic_now() + 10s;
  while (!condition()) {
    if (io::monotonic_now() > deadline) return false;
  }
  return true;
}

}  // namespace topo::daemon::testing
