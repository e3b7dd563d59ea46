// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// Scans, and the measures when they stop (PROTOCOLS section 13): QT and II, RS, RB twice on Ethernet, a new
// connection.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "core/types/invariant.hpp"

#include "drivers/hokuyo/connection_impl.hpp"

namespace topo::hokuyo {
namespace {

using namespace std::chrono_literals;
using types::Duration;

constexpr int kMaxBadInARow = 3;
/// Number of consecutive good scans that proves a measure against silence effective.
constexpr int kProvenScans = 40;
constexpr Duration kProbeLimit = 500ms;
constexpr Duration kLate = 300ms;  ///< of a scan; plausibility::PlausibilityParams::late_max

}  // namespace

bool Connection::Impl::on_scan(types::Scan& out) {
  if (pending.phase != Phase::kStreaming && pending.phase != Phase::kStart)
    return false;  // a remainder of an earlier stream
  if (!line.scan().echo.same_stream(stream.request)) {
    on_garbage();
    return false;
  }
  pending.phase = Phase::kStreaming;
  pending.deadline = now() + stream.silence_limit;
  const SensorClock::Result time = clock.on_scan(line.scan().time_ms, line.arrival());
  if (time.frozen) {
    set_health(Health::kFault, place() + ": the sensor's clock stands still; resetting the sensor");
    reset_sensor();
    return false;
  }
  if (time.repeated) return false;  // it has no stamp of its own; the gap counts it as lost
  if (is_late(time)) return false;
  faults.bad_in_a_row = 0;
  if (++faults.good_in_a_row >= kProvenScans) {
    faults.ladder = 0;
    retry.backoff = kBackoffMin;
  }
  retry.failures = 0;
  faults.faulty = false;
  if (verdict.health != Health::kStreaming && time.late <= kLate)
    set_health(Health::kStreaming, streaming_text());
  count_gap(time);
  fill(out, time);
  return true;
}

/// On a line that is too slow, scans queue up: each looks fresh by its arrival but is old. A sensor whose
/// clock was set looks the same. Driving has ended by then (types::Scan::late). A new stream begins with an
/// empty queue and a clock that was read anew; a short hold-up of the line is not worth the pause.
bool Connection::Impl::is_late(const SensorClock::Result& time) {
  constexpr Duration kLatestMax = 1s;
  constexpr int kInARow = 20;  // half a second
  faults.late_in_a_row = time.late > kLate ? faults.late_in_a_row + 1 : 0;
  if (time.late <= kLatestMax && faults.late_in_a_row < kInARow) return false;
  set_health(Health::kLate,
             place() +
                 ": scans come late by the sensor's clock: the line is too slow, or the clock was set; "
                 "starting the stream anew");
  faults.good_in_a_row = faults.late_in_a_row = 0;
  faults.clock_in_doubt = true;
  probe();
  return true;
}

void Connection::Impl::count_gap(const SensorClock::Result& time) {
  if (last_device_ms && !time.jumped) {
    const double periods = static_cast<double>(time.device_ms - *last_device_ms) * 1e-3 /
                           static_cast<double>(stream.geometry.period_s);
    const auto lost = static_cast<std::uint64_t>(std::max(std::lround(periods) - 1, 0L));
    counters.lost_scans += lost;
    sequence += lost;
  }
  last_device_ms = time.device_ms;
  ++sequence;
  ++counters.scans;
}

void Connection::Impl::fill(types::Scan& out, const SensorClock::Result& time) const {
  const RawScan& raw = line.scan();
  out.first_beam = time.host + stream.first_offset;
  out.arrival = line.arrival();
  out.late = time.late;
  out.sequence = sequence;
  out.geometry = stream.geometry;
  types::require(raw.points <= types::Scan::kMaxBeams, "hokuyo: more points than a scan holds");
  out.beams = static_cast<std::uint16_t>(raw.points);
  out.has_intensity = stream.intensity;
  for (std::size_t i = 0; i < raw.points; ++i)
    out.range_m[i] = stream.masked[i] ? types::kInvalid : stream.decode(raw.range_mm[i]);
  if (!stream.intensity) return;
  for (std::size_t i = 0; i < raw.points; ++i) {
    out.intensity[i] = static_cast<std::uint16_t>(std::min<std::uint32_t>(raw.intensity[i], 0xFFFF));
  }
}

void Connection::Impl::on_garbage() {
  if (pending.phase != Phase::kStreaming)
    return;  // from an earlier stream, or another protocol: kFind decides
  ++counters.checksum_errors;
  faults.good_in_a_row = 0;
  if (++faults.bad_in_a_row < kMaxBadInARow) return;
  faults.bad_in_a_row = 0;
  ++counters.resyncs;
  probe();
}

/// A reply during streaming: the sensor reports a fault (section 10.1, number 8), or replies to an earlier
/// request.
void Connection::Impl::on_stream_status() {
  const Reply& reply = line.reply();
  if (!parse_stream_echo(reply.echo()) || reply.status() == "00") return;
  const std::string status(reply.status());
  const std::string text =
      place() + ": the sensor reports status " + status + ", " + std::string(describe_status(status));
  if (status == "98") return;  // the following scans show the same
  set_health(Health::kFault, text);
  if (status >= "21" && status <= "49") return;  // it checks itself and resumes; else on_silence() follows
  faults.faulty = true;
  probe();
}

void Connection::Impl::on_silence() {
  if (!faults.faulty) {
    char limit[16];
    std::snprintf(limit, sizeof limit, "%.1f s", types::to_seconds(stream.silence_limit));
    set_health(Health::kSilent, place() + ": no scan for " + limit);
  }
  if (faults.ladder == 0) return probe();
  if (faults.ladder == 1) return reset_sensor();
  reboot_or_reconnect();
}

/// The mildest measure first: end the stream, request the state, start again.
void Connection::Impl::probe() {
  faults.ladder = std::max(faults.ladder, 1);  // the clock continues: scans missed meanwhile count as lost
  enter(Phase::kProbe, "QT", kProbeLimit);
}

/// Behind a bridge on TCP the sensor may be exchanged while the connection lasts: the stream is resumed only
/// with the one that it began with. Another one is connected to anew, with its own parameters.
void Connection::Impl::on_version_again() {
  SensorInfo answers;
  if (!read_version(line.reply(), answers)) return on_timeout();
  if (!same_serial(answers.serial_number, found.serial_number)) {
    return lose(Health::kDisconnected, place() + ": the sensor was exchanged (serial number " +
                                           answers.serial_number + ", before " + found.serial_number +
                                           "); connecting again");
  }
  if (pending.phase == Phase::kResetVersion) return restart_stream();
  enter(Phase::kProbeState, "II", 500ms);
}

void Connection::Impl::after_probe() {
  read_state(line.reply(), found);
  info = found;
  if (faults.clock_in_doubt) return restart_stream();
  if (!faults.faulty) return enter_laser();
  set_health(Health::kFault, verdict.message + "; its own words: \"" + found.status + "\"");
  reset_sensor();
}

void Connection::Impl::reset_sensor() {
  if (faults.ladder >= 2) return reboot_or_reconnect();
  faults.ladder = 2;
  last_device_ms.reset();
  enter(Phase::kReset, "RS", kProbeLimit);
}

void Connection::Impl::reboot_or_reconnect() {
  const bool rebooting = pending.phase == Phase::kReboot;
  if (!line.stream().has_baud() && !rebooting && faults.ladder < 3) {
    faults.ladder = 3;
    pending.tries = 0;
    return enter(Phase::kReboot, "RB", kProbeLimit);
  }
  // Two RB within a second reboot the sensor (section 10).
  if (rebooting && pending.tries++ == 0) return enter(Phase::kReboot, "RB", kProbeLimit);
  faults.ladder = 0;
  const Health last = verdict.health == Health::kFault ? Health::kFault : Health::kSilent;
  lose(last, verdict.message + (rebooting ? "; it was rebooted" : "; connecting again"));
}

std::string Connection::Impl::streaming_text() const {
  char text[160];
  std::snprintf(text, sizeof text, ": %s %s streams %zu beams at %.1f Hz", found.product.c_str(),
                found.serial_number.c_str(), stream.request.points(),
                1.0 / static_cast<double>(stream.geometry.period_s));
  std::string whole = place() + text;
  if (config.intensity && !stream.intensity) whole += "; this model has no intensities";
  return whole;
}

}  // namespace topo::hokuyo
