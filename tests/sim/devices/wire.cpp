// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/sim/devices/wire.hpp"

#include <algorithm>
#include <array>

namespace topo::sim {
namespace {

constexpr std::size_t kChunk = 4096;
constexpr double kBitsPerByte = 10.0;  // 8N1 (PROTOCOLS section 6.4)

}  // namespace

Wire::Wire(WireDevice& device, std::unique_ptr<Endpoint> endpoint, std::uint64_t seed)
    : device_(device), endpoint_(std::move(endpoint)), random_(seed) {}

void Wire::cut(SimTime until) {
  endpoint_->close();
  cut_ = true;
  cut_until_ = until;
}

void Wire::pump(SimTime now) {
  if (const auto absence = device_.take_absence(now)) cut(now + *absence);
  if (cut_ && now >= cut_until_)
    cut_ = !endpoint_->open().has_value();  // the port may still be busy: try again later
  endpoint_->service();
  notice_loss(now);
  receive(now);
  notice_loss(now);  // before the next service() accepts another client
  device_.tick(now);
  transmit(now);
  notice_loss(now);
}

void Wire::notice_loss(SimTime now) {
  const bool connected = endpoint_->connected();
  if (was_connected_ && !connected) {
    staged_.clear();
    from_device_.clear();  // a link that breaks loses what it carries
    to_device_.clear();
    if (!endpoint_->serial()) device_.client_gone(now);
  }
  was_connected_ = connected;
}

void Wire::receive(SimTime now) {
  std::array<std::uint8_t, kChunk> buffer;
  const std::size_t got = endpoint_->read(buffer);
  std::string bytes(buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(got));
  spoil(bytes);
  if (!bytes.empty()) to_device_.push(std::move(bytes), now);
  bytes = to_device_.take(now);
  if (bytes.empty()) return;
  device_.receive({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, now);
}

bool Wire::speeds_differ() const {
  const unsigned device_rate = device_.line_rate_bps();
  if (!endpoint_->serial() || device_rate == 0) return false;
  const unsigned client_rate = endpoint_->client_rate_bps();
  return client_rate != 0 && client_rate != device_rate;
}

void Wire::spoil(std::string& bytes) {
  if (drop_rate_ > 0.0) {
    std::uniform_real_distribution<double> uniform;
    std::erase_if(bytes, [&](char) { return uniform(random_) < drop_rate_; });
  }
  if (speeds_differ()) {
    // Every byte is corrupted when sampled at the wrong speed.
    for (char& byte : bytes) byte = static_cast<char>(byte ^ static_cast<char>(1 + random_() % 255));
  }
}

double Wire::bytes_per_s() const {
  const unsigned line = endpoint_->serial() ? device_.line_rate_bps() : 0;
  const double wire = line / kBitsPerByte;
  if (slow_bytes_per_s_ > 0.0) return wire > 0.0 ? std::min(wire, slow_bytes_per_s_) : slow_bytes_per_s_;
  return wire;
}

void Wire::discard_output(SimTime now) {
  staged_.clear();
  while (true) {
    const auto piece = device_.output().peek(now, kChunk);
    if (piece.empty()) return;
    device_.output().consume(piece.size());
  }
}

void Wire::stage(SimTime now) {
  staged_ = from_device_.take(now);
  if (!staged_.empty()) return;
  if (!from_device_.active()) {
    staged_ = next_piece(now);
    return;
  }
  for (std::string piece = next_piece(now); !piece.empty(); piece = next_piece(now))
    from_device_.push(std::move(piece), now);
}

std::string Wire::next_piece(SimTime now) {
  if (garbage_ > 0) {
    const std::size_t count = std::min(garbage_, kChunk);
    std::string noise;
    for (std::size_t i = 0; i < count; ++i) noise.push_back(static_cast<char>(random_()));
    garbage_ -= count;
    return noise;
  }
  const bool paced = bytes_per_s() > 0.0;
  const std::size_t most = paced ? std::min(kChunk, static_cast<std::size_t>(credit_)) : kChunk;
  std::string piece(device_.output().peek(now, most));
  if (piece.empty()) return piece;
  device_.output().consume(piece.size());
  if (paced) credit_ -= static_cast<double>(piece.size());
  spoil(piece);
  return piece;
}

void Wire::transmit(SimTime now) {
  const double rate = bytes_per_s();
  constexpr double kBurst_s = 0.02;
  credit_ = std::min(credit_ + seconds_of(now - last_) * rate, std::max(1.0, rate * kBurst_s));
  last_ = now;
  if (!endpoint_->connected() || now < silent_until_) return discard_output(now);
  while (true) {
    if (staged_.empty()) stage(now);
    if (staged_.empty()) return;
    const std::size_t put = endpoint_->write(staged_);
    staged_.erase(0, put);
    if (!staged_.empty()) return;  // the client does not read
  }
}

}  // namespace topo::sim
