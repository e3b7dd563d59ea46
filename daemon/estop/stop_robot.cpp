// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/estop/stop_robot.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <utility>

#include "drivers/pioneer/link.hpp"
#include "drivers/pioneer/sip.hpp"

namespace topo::daemon {
namespace {

using pioneer::Command;
using pioneer::encode;
using std::chrono::milliseconds;
using types::Duration;
using types::Errc;
using types::Result;
using types::Stamp;
using types::Status;

constexpr Duration kConnectTime = milliseconds(300);
constexpr Duration kRetryPause = milliseconds(40);
/// Longer than the 100 ms between two status packets, so that an open connection is detected at the line's
/// own speed.
constexpr Duration kListenFirst = milliseconds(150);
constexpr Duration kListenOther = milliseconds(70);
/// Time to send CLOSE. Meanwhile input is read: closing a socket with unread bytes resets it, and a reset can
/// discard what was written.
constexpr Duration kClosing = milliseconds(60);
constexpr int kPresentSpeed = 0;
constexpr std::array kSpeeds{kPresentSpeed, 9600, 38400, 19200, 115200, 57600};  // PROTOCOLS section 1.2

/// The stop on one opened port.
class Stopping {
 public:
  Stopping(std::unique_ptr<io::ByteStream> stream, Stamp deadline)
      : link_(std::move(stream), counters_), deadline_(deadline) {}

  Result<StopOutcome> run() {
    for (const int speed : kSpeeds) {
      if (auto done = stop_at(speed); !done) return tl::unexpected(done.error());
      if (heard_ || !link_.has_baud() || link_.now() >= deadline_) break;
    }
    if (!heard_) return StopOutcome::kSilent;
    return stands_ ? StopOutcome::kStands : StopOutcome::kMoves;
  }

 private:
  Status stop_at(int speed);
  Status exchange(Stamp until, bool until_standing);
  void on_packet(const pioneer::PacketView& packet);

  pioneer::Counters counters_;
  pioneer::Link link_;
  Stamp deadline_;
  bool heard_ = false;
  bool stands_ = false;
};

Status Stopping::stop_at(int speed) {
  if (speed != kPresentSpeed) {
    if (auto set = link_.set_baud(speed); !set) return set;
  }
  pioneer::Outbox& out = link_.outbox();
  out.set_estop();
  out.push(encode(Command::kVel, 0));
  out.push(encode(Command::kRvel, 0));
  const Stamp braked = deadline_ - kClosing;
  const Duration listen = speed == kPresentSpeed ? kListenFirst : kListenOther;
  if (auto s = exchange(std::min(link_.now() + listen, braked), true); !s) return s;
  if (heard_) {
    if (auto s = exchange(braked, true); !s) return s;
  }
  out.push(encode(Command::kClose, 1));  // with its argument: without it, a waiting robot takes it for SYNC2
  const bool last = heard_ || !link_.has_baud();
  return exchange(link_.now() + (last ? kClosing : link_.wire_time(64)), false);
}

/// Sends waiting commands and reads input; ends early when all are sent and the robot reports standstill.
Status Stopping::exchange(Stamp until, bool until_standing) {
  while (link_.now() < until || !link_.outbox().empty()) {
    if (auto sent = link_.pump(); !sent) return sent;
    while (const auto packet = link_.next_packet()) on_packet(*packet);
    if (until_standing && stands_ && link_.outbox().empty()) break;
    const Stamp wake = link_.outbox().empty() ? until : link_.next_send();
    if (auto got = link_.receive(wake - link_.now()); !got) return got;
  }
  return {};
}

void Stopping::on_packet(const pioneer::PacketView& packet) {
  const auto status = pioneer::decode_status(packet.payload);
  if (!status) return;
  heard_ = true;
  stands_ = status->left_velocity == 0 && status->right_velocity == 0;
}

Result<StopOutcome> attempt(io::Connector& connector, Stamp deadline) {
  auto stream = connector.connect(std::min(kConnectTime, deadline - connector.now()));
  if (!stream) return tl::unexpected(stream.error());
  return Stopping(std::move(*stream), deadline).run();
}

/// True for errors that waiting does not cure.
bool is_final(Errc code) {
  return code == Errc::kInvalidInput || code == Errc::kNotFound || code == Errc::kPermission;
}

}  // namespace

Result<StopOutcome> stop_robot(io::Connector& connector, Duration limit) {
  const Stamp deadline = connector.now() + limit;
  for (;;) {
    auto outcome = attempt(connector, deadline);
    if (outcome || is_final(outcome.error().code)) return outcome;
    if (connector.now() + kRetryPause + kClosing >= deadline) return outcome;
    connector.pause(kRetryPause);
  }
}

}  // namespace topo::daemon
