// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/hokuyo/connection.hpp"

#include <algorithm>
#include <utility>

#include "drivers/hokuyo/connection_impl.hpp"

namespace topo::hokuyo {
namespace {

using namespace std::chrono_literals;
using types::Duration;
using types::Errc;
using types::Stamp;

constexpr Duration kBackoffMax = 5s;
constexpr Duration kOpenLimit = 3s;

}  // namespace

Connection::Impl::Impl(ConnectionConfig config_in, std::unique_ptr<io::Connector> connector_in)
    : config(std::move(config_in)), connector(std::move(connector_in)) {
  verdict.message = place() + ": not connected yet";
  pending.deadline = connector->now();
}

Stamp Connection::Impl::now() const { return line.is_open() ? line.now() : connector->now(); }

std::string Connection::Impl::place() const {
  std::string text = "laser " + config.name + " (";
  text.append(connector->name());
  return text + ")";
}

StepOutcome Connection::Impl::step(types::Scan& out, Duration timeout) {
  const Stamp until = now() + timeout;
  for (;;) {
    if (std::exchange(verdict.changed, false)) return StepOutcome::kChanged;
    if (advance(out, until)) return StepOutcome::kScan;
    if (!verdict.changed && now() >= until) return StepOutcome::kNothing;
  }
}

bool Connection::Impl::advance(types::Scan& out, Stamp until) {
  if (!line.is_open()) {
    advance_closed(until);
    return false;
  }
  const auto event = line.poll(std::min(until, pending.deadline));
  counters.bytes = line.bytes();
  if (!event) {
    lose(Health::kDisconnected, event.error().message);
    return false;
  }
  const bool scan = on_event(*event, out);
  if (!scan && line.is_open() && now() >= pending.deadline) on_timeout();
  return scan;
}

void Connection::Impl::advance_closed(Stamp until) {
  if (pending.phase == Phase::kBackoff) {
    if (now() < pending.deadline) {
      connector->pause(std::min(until, pending.deadline) - now());
      return;
    }
    pending.phase = Phase::kOpening;
    pending.deadline = now() + kOpenLimit;
  }
  auto opened = connector->connect(std::max<Duration>(std::min(until, pending.deadline) - now(), 1ms));
  if (!opened) {
    // A connection attempt in progress continues in the next step.
    if (opened.error().code != Errc::kTimeout || now() >= pending.deadline)
      lose(Health::kDisconnected, opened.error().message);
    return;
  }
  line.open(std::move(*opened));
  if (++retry.connections > 1) ++counters.reconnects;
  if (retry.failures == 0) set_health(Health::kConnecting, place() + ": connected, asking for identity");
  start_finding();
}

bool Connection::Impl::on_event(ScipParser::Event event, types::Scan& out) {
  switch (event) {
    case ScipParser::Event::kNone:
      return false;
    case ScipParser::Event::kReply:
      on_reply();
      return false;
    case ScipParser::Event::kScan:
      return on_scan(out);
    case ScipParser::Event::kGarbage:
      on_garbage();
      return false;
  }
  return false;
}

void Connection::Impl::on_reply() {
  if (pending.phase == Phase::kStreaming) return on_stream_status();
  // Late replies to earlier requests may arrive: only the reply to the current request counts.
  if (line.reply().echo() != pending.sent.view()) return;
  switch (pending.phase) {
    case Phase::kFind:
      return on_find_reply();
    case Phase::kLeaveAdjust:
      return find_step();
    case Phase::kVersion:
      return on_version();
    case Phase::kParameters:
      return on_parameters();
    case Phase::kState:
      read_state(line.reply(), found);
      return prepare_stream();
    case Phase::kAdjust:
      return on_adjust_reply();
    case Phase::kSample:
      return on_sample();
    case Phase::kAdjusted:
      return enter_laser();
    case Phase::kLaser:
      return on_laser_reply();
    case Phase::kStart:
      return on_start_reply();
    case Phase::kProbe:
      return enter(Phase::kProbeVersion, "VV", 500ms);
    case Phase::kProbeVersion:
    case Phase::kResetVersion:
      return on_version_again();
    case Phase::kProbeState:
      return after_probe();
    case Phase::kReset:
      return enter(Phase::kResetVersion, "VV", 500ms);
    case Phase::kReboot:
      return reboot_or_reconnect();
    case Phase::kBackoff:
    case Phase::kOpening:
    case Phase::kLaserPause:
    case Phase::kStreaming:
      return;
  }
}

void Connection::Impl::on_timeout() {
  switch (pending.phase) {
    case Phase::kFind:
      return find_next();
    case Phase::kLeaveAdjust:
      return find_step();
    case Phase::kVersion:
    case Phase::kParameters:
      return retry_version();
    case Phase::kState:
      return prepare_stream();  // only text for messages
    case Phase::kAdjust:
    case Phase::kSample:
      return enter(Phase::kAdjusted, "TM2", 300ms);
    case Phase::kAdjusted:
      return enter_laser();
    case Phase::kLaser:
      return retry_laser();
    case Phase::kLaserPause:
      return enter(Phase::kLaser, "BM", 500ms);
    case Phase::kStart:
    case Phase::kStreaming:
      return on_silence();
    case Phase::kProbe:
    case Phase::kProbeVersion:
    case Phase::kProbeState:
      return reset_sensor();
    case Phase::kReset:
    case Phase::kResetVersion:
    case Phase::kReboot:
      return reboot_or_reconnect();
    case Phase::kBackoff:
    case Phase::kOpening:
      return;
  }
}

/// Sends the phase's request and waits for its reply for `limit`.
void Connection::Impl::enter(Phase next, std::string_view text, Duration limit) {
  pending.phase = next;
  pending.sent = RequestText{};
  pending.sent.append(text);
  pending.asked = now();
  pending.deadline = pending.asked + limit;
  if (auto written = line.send(text); !written) lose(Health::kDisconnected, written.error().message);
}

void Connection::Impl::lose(Health state, const std::string& why) {
  line.close();
  last_device_ms.reset();
  faults.good_in_a_row = 0;
  ++retry.failures;
  pending.phase = Phase::kBackoff;
  pending.deadline = now() + retry.backoff;
  retry.backoff = std::min(2 * retry.backoff, kBackoffMax);
  set_health(state, why);
}

void Connection::Impl::set_health(Health state, std::string text) {
  if (state == verdict.health && text == verdict.message) return;
  verdict.health = state;
  verdict.message = std::move(text);
  verdict.changed = true;
}

void Connection::Impl::close(Duration timeout) {
  if (!line.is_open()) return;
  const Stamp until = now() + timeout;
  const bool adjusting = pending.phase == Phase::kAdjust || pending.phase == Phase::kSample;
  if (adjusting) (void)line.send("TM2");  // QT is refused in adjust mode; a failure of TM2 shows at QT
  bool quiet = !line.send("QT");
  while (!quiet && now() < until) {
    const auto event = line.poll(until);
    quiet = !event || (*event == ScipParser::Event::kReply && line.reply().echo() == "QT");
  }
  line.close();
  pending.phase = Phase::kBackoff;
  pending.deadline = now();
  verdict.health = Health::kDisconnected;
  verdict.message = place() + ": closed";
}

Connection::Connection(ConnectionConfig config, std::unique_ptr<io::Connector> connector)
    : impl_(std::make_unique<Impl>(std::move(config), std::move(connector))) {}
Connection::~Connection() = default;
StepOutcome Connection::step(types::Scan& out, Duration timeout) { return impl_->step(out, timeout); }
void Connection::close(Duration timeout) { impl_->close(timeout); }
Health Connection::health() const { return impl_->verdict.health; }
const std::string& Connection::message() const { return impl_->verdict.message; }
const std::optional<SensorInfo>& Connection::info() const { return impl_->info; }
const Counters& Connection::counters() const { return impl_->counters; }

}  // namespace topo::hokuyo
