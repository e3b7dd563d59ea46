// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/mocks/scripted_stream.hpp"

#include <algorithm>
#include <cstring>

namespace topo::mocks {

using types::Errc;

void ScriptedLine::send_at(types::Stamp when, std::string_view bytes) {
  if (head_ < queue_.size()) when = std::max(when, queue_.back().when);
  queue_.push_back({when, std::string(bytes)});
}

void ScriptedLine::unplug() {
  connected_ = false;
  clear_queue();
}

void ScriptedLine::clear_queue() {
  queue_.clear();
  head_ = 0;
  offset_ = 0;
}

io::ReadResult ScriptedLine::take(std::span<std::byte> buffer, types::Duration timeout) {
  const types::Stamp until = now + std::max(timeout, types::Duration::zero());
  if (on_wait) on_wait(until);
  if (head_ == queue_.size() || queue_[head_].when > until || buffer.empty()) {
    now = until;
    return {0, now};
  }
  now = std::max(now, queue_[head_].when);
  std::size_t filled = 0;
  const std::size_t room = std::min(buffer.size(), max_read);
  while (filled < room && head_ < queue_.size() && queue_[head_].when <= now) {
    const std::string& bytes = queue_[head_].bytes;
    const std::size_t count = std::min(room - filled, bytes.size() - offset_);
    std::memcpy(buffer.data() + filled, bytes.data() + offset_, count);
    filled += count;
    offset_ += count;
    if (offset_ == bytes.size()) {
      ++head_;
      offset_ = 0;
    }
  }
  return {filled, now};
}

/// One connection. A newer connection or unplug() makes it dead.
class ScriptedStream final : public io::ByteStream {
 public:
  ScriptedStream(ScriptedLine& line, int generation) : line_(&line), generation_(generation) {}
  ~ScriptedStream() override {
    if (alive()) line_->connected_ = false;
  }
  ScriptedStream(const ScriptedStream&) = delete;
  ScriptedStream& operator=(const ScriptedStream&) = delete;

  io::Result<io::ReadResult> read(std::span<std::byte> buffer, types::Duration timeout) override {
    if (!alive()) return types::fail(Errc::kClosed, "/dev/scripted: unplugged");
    const io::ReadResult result = line_->take(buffer, timeout);
    if (!alive()) return types::fail(Errc::kClosed, "/dev/scripted: unplugged");
    return result;
  }

  io::Status write(std::span<const std::byte> bytes, types::Duration /*timeout*/) override {
    if (!alive()) return types::fail(Errc::kClosed, "/dev/scripted: unplugged");
    const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    line_->written += text;
    if (line_->on_write) line_->on_write(text);
    return {};
  }

  io::Status set_baud(int baud) override {
    line_->baud = baud;
    return {};
  }
  [[nodiscard]] bool has_baud() const override { return line_->has_baud; }
  [[nodiscard]] types::Stamp now() const override { return line_->now; }

 private:
  [[nodiscard]] bool alive() const { return line_->connected_ && line_->generation_ == generation_; }

  ScriptedLine* line_;
  int generation_;
};

io::Result<std::unique_ptr<io::ByteStream>> ScriptedConnector::connect(types::Duration /*timeout*/) {
  ++line_->connect_calls;
  line_->connect_stamps.push_back(line_->now);
  if (line_->refuse) return types::fail(Errc::kNotFound, "/dev/scripted: cannot open: no such device");
  line_->clear_queue();
  line_->connected_ = true;
  ++line_->connections;
  ++line_->generation_;
  if (line_->on_connect) line_->on_connect();
  return std::make_unique<ScriptedStream>(*line_, line_->generation_);
}

}  // namespace topo::mocks
