// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/pioneer/arcos_can_stream.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "drivers/pioneer/arcos_codec.hpp"

namespace topo::pioneer {
namespace {

using io::BusFault;
using std::chrono::milliseconds;
using types::Duration;
using types::Errc;
using types::Stamp;
using types::Status;

constexpr Duration kSendTime = milliseconds(100);        // N_As, also for a stop
constexpr Duration kSendAgain = milliseconds(1);         // a full queue sends four frames in it at 500 kbit/s
constexpr Duration kUnacknowledged = milliseconds(500);  // five heartbeats

/// True for a stop as a whole packet: FA FB, count, type byte.
bool is_stop(std::span<const std::byte> packet) {
  constexpr std::size_t kStopSize = 6, kTypeAt = 3;
  if (packet.size() != kStopSize) return false;
  return packet[kTypeAt] == static_cast<std::byte>(Command::kEStop) ||
         packet[kTypeAt] == static_cast<std::byte>(Command::kStop);
}

bool is_busy(const Status& status) { return !status && status.error().code == Errc::kBusy; }

}  // namespace

ArcosCanStream::~ArcosCanStream() {
  std::array<std::byte, kMaxPacket> ignored{};
  for (const Stamp end = now() + kSendTime; !ready() && now() < end;) {
    if (!read(ignored, end - now())) return;
  }
}

Status ArcosCanStream::write(std::span<const std::byte> packet, Duration /*timeout*/) {
  if (is_stop(packet)) return write_stop(packet[3]);
  if (!ready() || !sender_.begin(packet)) return types::fail(Errc::kBusy, "busy");  // short: no allocation
  return pump();
}

Status ArcosCanStream::write_stop(std::byte command) {
  if (transfer_under_way()) ++faults_[BusFault::kInterrupted];
  sender_.abort();
  waiting_.reset();
  if (!stop_) stop_ = Stop{{}, now()};
  stop_->data.size = 1;
  // A waiting emergency stop is not replaced by a plain one.
  if (stop_->data.bytes[0] != static_cast<std::byte>(Command::kEStop)) stop_->data.bytes[0] = command;
  stop_->overtook = false;
  return send_stop();
}

Status ArcosCanStream::send_stop() {
  if (!stop_) return {};
  Status sent;
  if (!stop_->overtook) sent = port_->send_first(id(kCanStop), stop_->data);
  stop_->overtook = sent.has_value();
  if (sent) sent = port_->send(id(kCanStop), stop_->data);
  if (sent) stop_.reset();
  if (!is_busy(sent)) return sent;
  ++faults_[BusFault::kQueueFull];
  retry_at_ = now() + kSendAgain;
  if (now() - stop_->since < kSendTime) return {};
  stop_.reset();
  return types::fail(Errc::kTimeout,
                     std::string(port_->name()) + ": a stop did not get out: the interface takes no frames");
}

/// Sends frames that are due, a stop before all others. A frame that finds the queue full is retried; after
/// N_As the transfer is aborted.
Status ArcosCanStream::pump() {
  if (auto sent = send_stop(); !sent || stop_) return sent;
  return send_transfer();
}

Status ArcosCanStream::send_transfer() {
  for (;;) {
    if (!waiting_) {
      const auto next = sender_.next(now());
      if (!next) return {};
      waiting_ = Unsent{*next, now()};
    }
    auto sent = port_->send(id(kCanToRobot), waiting_->data);
    if (sent) {
      waiting_.reset();
      continue;
    }
    if (!is_busy(sent)) return sent;
    ++faults_[BusFault::kQueueFull];
    retry_at_ = now() + kSendAgain;
    if (now() - waiting_->since < kSendTime) return {};
    ++faults_[BusFault::kUnanswered];
    sender_.abort();
    waiting_.reset();
  }
}

/// A flow control frame that finds the queue full is lost: the robot aborts that packet and continues with
/// the next.
Status ArcosCanStream::send_reply(const io::CanData& reply) {
  auto sent = port_->send(id(kCanToRobot), reply);
  if (!is_busy(sent)) return sent;
  ++faults_[BusFault::kQueueFull];
  return {};
}

void ArcosCanStream::expire() {
  // A frame that still waits has a limit of its own, which includes that of its answer.
  if (!waiting_ && sender_.expire(now()) != io::IsoTpFault::kNone) ++faults_[BusFault::kUnanswered];
  if (receiver_.expire(now()) != io::IsoTpFault::kNone) ++faults_[BusFault::kBadTransfer];
}

Stamp ArcosCanStream::due() const {
  return std::min(stop_ || waiting_ ? retry_at_ : sender_.due(), receiver_.deadline());
}

types::Result<io::ReadResult> ArcosCanStream::read(std::span<std::byte> buffer, Duration timeout) {
  const Stamp deadline = now() + std::min(timeout, Stamp::max() - now());
  const bool was_ready = ready();
  for (;;) {
    if (!packet_.empty()) {
      const std::size_t size = std::min(packet_.size(), buffer.size());
      std::copy_n(packet_.begin(), size, buffer.begin());
      packet_ = packet_.subspan(size);
      return io::ReadResult{size, packet_stamp_};
    }
    expire();
    if (auto sent = pump(); !sent) return tl::unexpected(std::move(sent.error()));
    if (ready() && !was_ready) return io::ReadResult{0, now()};
    const Duration wait = std::min(deadline, due()) - now();
    auto event = port_->receive(std::max(wait, Duration::zero()));
    if (!event) return tl::unexpected(std::move(event.error()));
    if (auto done = on_event(*event); !done) return tl::unexpected(std::move(done.error()));
    // A frame that arrived before the deadline is taken even when this thread is late; later ones wait for
    // the next call.
    const auto* frame = std::get_if<io::CanFrame>(&*event);
    const bool in_time = frame != nullptr && frame->stamp <= deadline;
    if (!in_time && packet_.empty() && now() >= deadline) return io::ReadResult{0, now()};
  }
}

Status ArcosCanStream::on_event(const io::CanEvent& event) {
  faults_[BusFault::kDropped] = port_->dropped();
  if (const auto* frame = std::get_if<io::CanFrame>(&event)) return on_frame(*frame);
  if (const auto* error = std::get_if<io::CanError>(&event)) return on_error(*error);
  return {};
}

Status ArcosCanStream::on_frame(const io::CanFrame& frame) {
  unacknowledged_since_ = {};
  if (frame.id != id(kCanFromRobot)) return {};
  if (io::is_flow_control(frame.data.view())) {
    const auto fault = sender_.take_flow(frame.data.view(), now());
    if (fault == io::IsoTpFault::kRefused || fault == io::IsoTpFault::kFlowStatus)
      ++faults_[BusFault::kUnanswered];
    return {};
  }
  const auto taken = receiver_.take(frame.data.view(), now());
  if (taken.fault != io::IsoTpFault::kNone) ++faults_[BusFault::kBadTransfer];
  if (!taken.pdu.empty()) on_packet(taken.pdu, frame.stamp);
  return taken.reply ? send_reply(*taken.reply) : Status{};
}

/// One message is exactly one packet; any other message is dropped whole, so that no remainder corrupts the
/// next packet.
void ArcosCanStream::on_packet(std::span<const std::byte> pdu, Stamp stamp) {
  PacketParser parser;
  std::span<const std::byte> rest = pdu;
  const auto packet = parser.next(rest, stamp);
  if (!packet || packet->wire_bytes() != pdu.size()) {
    ++faults_[BusFault::kBadMessage];
    return;
  }
  packet_ = pdu;
  packet_stamp_ = stamp;
}

Status ArcosCanStream::on_error(const io::CanError& error) {
  const std::array<std::pair<bool, BusFault>, 5> survived{
      {{error.passive, BusFault::kPassive},
       {error.violation, BusFault::kViolation},
       {error.transmit_timeout, BusFault::kTransmitTimeout},
       {error.overflow, BusFault::kOverflow},
       {error.restarted, BusFault::kRestarted}}};
  for (const auto& [holds, fault] : survived) faults_[fault] += holds ? 1 : 0;
  if (!error.bus_off && !error.no_acknowledge) return {};
  const std::string name(port_->name());
  if (error.bus_off) return types::fail(Errc::kClosed, name + ": " + to_text(error));
  if (unacknowledged_since_ == Stamp{}) unacknowledged_since_ = now();
  if (now() - unacknowledged_since_ < kUnacknowledged) return {};
  unacknowledged_since_ = {};
  return types::fail(Errc::kClosed, name + ": " + to_text(error) +
                                        ": no other device is on the bus; is the robot switched on, and both "
                                        "ends of the bus terminated?");
}

}  // namespace topo::pioneer
