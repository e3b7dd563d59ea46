// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/fuzz/drive/hostile_line.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

namespace topo::fuzz {
namespace {

constexpr types::Duration kSlice = std::chrono::milliseconds(5);

class Stream final : public io::ByteStream {
 public:
  explicit Stream(HostilePort& port) : port_(&port), opened_(port.opened) {}

  io::Result<io::ReadResult> read(std::span<std::byte> buffer, types::Duration timeout) override {
    const types::Stamp until = port_->now + std::max(timeout, types::Duration::zero());
    if (port_->advance) port_->advance(port_->now);
    while (alive() && !port_->line->has(port_->now) && port_->now < until) {
      port_->now = std::min(until, port_->now + kSlice);
      if (port_->advance) port_->advance(port_->now);
    }
    if (!alive()) return types::fail(types::Errc::kClosed, "/dev/hostile: unplugged");
    const std::string got = port_->line->read(port_->now, buffer.size());
    std::memcpy(buffer.data(), got.data(), got.size());
    return io::ReadResult{got.size(), port_->now};
  }
  io::Status write(std::span<const std::byte> bytes, types::Duration /*timeout*/) override {
    if (!alive()) return types::fail(types::Errc::kClosed, "/dev/hostile: unplugged");
    port_->on_write({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    return {};
  }
  io::Status set_baud(int /*baud*/) override { return {}; }
  [[nodiscard]] bool has_baud() const override { return false; }
  [[nodiscard]] types::Stamp now() const override { return port_->now; }

 private:
  [[nodiscard]] bool alive() const { return !port_->unplugged && port_->opened == opened_; }

  HostilePort* port_;
  std::uint64_t opened_;
};

}  // namespace

io::Result<std::unique_ptr<io::ByteStream>> HostileConnector::connect(types::Duration /*timeout*/) {
  if (port_->unplugged) return types::fail(types::Errc::kNotFound, "/dev/hostile: no such device");
  ++port_->opened;
  port_->line->clear();  // what came before nobody has kept
  return std::unique_ptr<io::ByteStream>(std::make_unique<Stream>(*port_));
}

void HostileConnector::pause(types::Duration duration) {
  port_->now += std::max(duration, types::Duration::zero());
  if (port_->advance) port_->advance(port_->now);
}

std::uint32_t HostileLine::roll() {
  dice_ = dice_ * 1664525U + 1013904223U;  // Numerical Recipes
  return dice_ >> 8U;
}

void HostileLine::put(std::string bytes, types::Stamp due, types::Stamp sent, const Says& says) {
  last_due_ = std::max(due, last_due_);
  queue_.push_back({last_due_, std::move(bytes), sent, says});
}

void HostileLine::hear(const Chunk& chunk) {
  if (chunk.says.lie > 0) {
    heard_.lies = chunk.says.lie == last_lie_ ? heard_.lies + 1 : 1;
    heard_.lie = std::max(heard_.lie, chunk.sent);
  } else if (chunk.says.news) {
    heard_.lies = 0;
    heard_.news = std::max(heard_.news, chunk.sent);
  } else {
    return;
  }
  last_lie_ = chunk.says.lie;
}

void HostileLine::send(std::string_view message, types::Stamp now, const Says& says) {
  constexpr unsigned kPermille = 1000;
  std::string bytes;
  if (!faults.swallows) {
    for (char c : message) {
      if (faults.drop_permille > 0 && roll() % kPermille < faults.drop_permille) continue;
      if (faults.flip_permille > 0 && roll() % kPermille < faults.flip_permille)
        c = static_cast<char>(c ^ static_cast<char>(1U << (roll() % 7U)));
      bytes.push_back(c);
    }
  }
  const bool whole = bytes == message;
  delay_ += faults.delay_growth;
  constexpr types::Duration kNewStream = std::chrono::milliseconds(500);
  if (says.news || says.lie > 0) {
    if (now - last_sent_ > kNewStream) began_late_ = delay_;
    last_sent_ = now;
  }
  last_ = bytes;
  put(std::move(bytes), now + delay_, now, whole ? says : Says{});
}

void HostileLine::clear() {
  queue_.clear();
  offset_ = 0;
  last_due_ = {};
}

bool HostileLine::has(types::Stamp now) const {
  return !faults.holds && !queue_.empty() && queue_.front().due <= now;
}

std::string HostileLine::read(types::Stamp now, std::size_t most) {
  std::string out;
  while (has(now) && out.size() < most) {
    Chunk& first = queue_.front();
    const std::size_t count = std::min(most - out.size(), first.bytes.size() - offset_);
    out.append(first.bytes, offset_, count);
    offset_ += count;
    if (offset_ < first.bytes.size()) break;
    hear(first);
    queue_.pop_front();
    offset_ = 0;
  }
  return out;
}

}  // namespace topo::fuzz
