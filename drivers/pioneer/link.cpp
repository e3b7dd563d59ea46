// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/pioneer/link.hpp"

#include <algorithm>
#include <utility>

namespace topo::pioneer {

Link::Link(std::unique_ptr<io::ByteStream> stream, Counters& counters)
    : stream_(std::move(stream)),
      counters_(counters),
      last_send_(stream_->now()),
      send_after_(last_send_),
      last_read_(last_send_),
      read_ended_(last_send_),
      heard_after_(last_send_),
      last_request_(last_send_) {}

types::Status Link::pump() {
  if (outbox_.empty()) return {};
  if (stream_->ready()) return now() >= send_after_ ? send_next() : types::Status{};
  if (outbox_.stop_waits()) return interrupt_with(outbox_.pop());
  // The transfer in progress may remain unanswered for 100 ms, during which the robot would drive on.
  if (last_ && last_->is_setpoint() && outbox_.standstill_waits())
    return interrupt_with(encode(Command::kStop));
  return {};
}

types::Status Link::interrupt_with(const CommandPacket& stop) {
  const auto given_up = std::exchange(last_, std::nullopt);
  auto sent = send(stop);
  // Limits and switches remain valid after a stop; an earlier setpoint does not.
  if (given_up && !given_up->is_setpoint()) outbox_.give_back(*given_up);
  return sent;
}

types::Status Link::send_next() {
  last_.reset();
  if (outbox_.stop_waits()) return send(outbox_.pop());
  last_ = outbox_.pop();
  return send(*last_);
}

types::Status Link::send_at_once(const CommandPacket& packet) {
  if (!packet.is_emergency_stop()) {
    if (auto finished = finish_transfer(); !finished) return finished;
  }
  return send(packet);
}

/// Also keeps the spacing after the transfer.
types::Status Link::finish_transfer() {
  if (stream_->ready()) return {};
  for (const types::Stamp end = now() + kFinishTime; now() < end;) {
    if (stream_->ready() && now() >= send_after_) break;
    pending_ = {};
    if (auto read = receive((stream_->ready() ? send_after_ : end) - now()); !read) return read;
  }
  return {};
}

void Link::clear() {
  outbox_.clear();
  last_.reset();
}

types::Status Link::send(const CommandPacket& packet) {
  last_send_ = now();
  send_after_ = last_send_ + kSpacing + wire_time(packet.bytes().size());
  ++counters_.commands;
  auto written = stream_->write(packet.bytes(), kWriteTimeout);
  if (packet.is(Command::kEncoder)) last_request_ = now();
  return written;
}

types::Stamp Link::next_send() const {
  return outbox_.empty() || !stream_->ready() ? types::Stamp::max() : send_after_;
}

types::Status Link::receive(types::Duration timeout) {
  if (!pending_.empty()) return {};
  last_read_ = now();
  const bool under_way = !stream_->ready();
  const auto got = stream_->read(buffer_, std::max(timeout, types::Duration::zero()));
  heard_after_ = std::exchange(read_ended_, now());
  // The controller has a command when its last byte has arrived: the spacing begins then.
  if (under_way && stream_->ready()) send_after_ = now() + kSpacing;
  count_bus_faults();
  if (!got) return tl::unexpected(got.error());
  pending_ = std::span<const std::byte>(buffer_).first(std::min(got->bytes, buffer_.size()));
  pending_stamp_ = got->stamp;
  counters_.bytes += pending_.size();
  const std::size_t kept = std::min(pending_.size(), heard_.size() - heard_size_);
  std::copy_n(pending_.begin(), kept, heard_.begin() + static_cast<std::ptrdiff_t>(heard_size_));
  heard_size_ += kept;
  return {};
}

std::optional<PacketView> Link::next_packet() {
  const auto packet = parser_.next(pending_, pending_stamp_);
  count_bad_packets();
  return packet;
}

void Link::count_bad_packets() {
  const ParserCounters& c = parser_.counters();
  const std::uint64_t bad = c.bad_checksums + c.bad_counts + c.abandoned;
  counters_.bad_packets += bad - std::exchange(bad_before_, bad);
}

void Link::count_bus_faults() {
  const io::BusFaults now = stream_->faults();
  counters_.bus -= std::exchange(bus_before_, now);
  counters_.bus += now;
}

types::Status Link::set_baud(int baud) {
  parser_.reset();
  pending_ = {};
  heard_size_ = 0;
  baud_ = baud;
  return stream_->set_baud(baud);
}

types::Duration Link::wire_time(std::size_t bytes) const {
  constexpr std::int64_t kBitsPerByte = 10;  // 8N1
  if (baud_ <= 0) return {};
  return types::Duration{static_cast<std::int64_t>(bytes) * kBitsPerByte * 1'000'000'000 / baud_};
}

std::string Link::heard() const {
  const auto bytes = std::span(heard_).first(heard_size_);
  const auto is_text = [](std::byte b) {
    const auto c = std::to_integer<unsigned>(b);
    return c == '\n' || c == '\r' || (c >= 0x20 && c < 0x7F);
  };
  const bool text = std::all_of(bytes.begin(), bytes.end(), is_text);
  constexpr const char* kDigits = "0123456789abcdef";
  std::string out = text ? "\"" : "";
  for (const std::byte b : bytes) {
    const auto c = std::to_integer<unsigned>(b);
    if (!text) out.append(out.empty() ? "" : " ").append({kDigits[c >> 4U], kDigits[c & 15U]});
    if (text && c == '\n') out.append("\\n");
    if (text && c != '\n' && c != '\r') out.push_back(static_cast<char>(c));
  }
  return text ? out + "\"" : out;
}

}  // namespace topo::pioneer
