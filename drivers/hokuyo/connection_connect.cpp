// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// From an open port to a running stream: find protocol and line speed, identify, synchronise the clock,
// switch the laser on.
#include <algorithm>
#include <array>
#include <numbers>
#include <utility>

#include "drivers/hokuyo/connection_impl.hpp"

namespace topo::hokuyo {
namespace {

using namespace std::chrono_literals;
using types::Duration;

/// PROTOCOLS section 13: QT; SCIP2.0 for a URG at power-up; RS for a sensor that reacts to nothing else.
constexpr std::array<std::string_view, 5> kFindRequests{"QT", "SCIP2.0", "QT", "RS", "QT"};
constexpr std::array<int, 3> kBauds{19200, 38400, 115200};
constexpr Duration kFindLimit = 500ms;
constexpr Duration kAskLimit = 1s;
constexpr int kMaxTries = 3;
constexpr int kSamples = 10;
constexpr Duration kSpinUpLimit = 10s;
constexpr Duration kLaserPause = 500ms;

/// What a reply that cannot be taken says of the sensor.
Health unread(const types::Error& error) {
  return error.code == types::Errc::kUnsupported ? Health::kUnusable : Health::kDamaged;
}

bool is_good(std::string_view status) { return status == "00" || status == "02"; }

}  // namespace

void Connection::Impl::start_finding() {
  line_search = {};
  pending.tries = 0;
  faults = {};
  found = SensorInfo{};
  find_step();
}

void Connection::Impl::find_step() {
  if (line_search.find_index == 0 && line.stream().has_baud()) {
    if (auto set = line.stream().set_baud(kBauds[line_search.baud_index]); !set)
      return lose(Health::kDisconnected, set.error().message);
  }
  enter(Phase::kFind, kFindRequests[line_search.find_index], kFindLimit);
}

void Connection::Impl::find_next() {
  if (++line_search.find_index == kFindRequests.size()) {
    line_search.find_index = 0;
    if (!line.stream().has_baud() || ++line_search.baud_index == kBauds.size()) return not_found();
  }
  find_step();
}

void Connection::Impl::not_found() {
  const std::string expected = "; expected a Hokuyo sensor that speaks SCIP 2.0";
  if (line.heard_arcos()) {
    return lose(Health::kWrongDevice, place() + ": a Pioneer base answers here (ARCOS packets)" + expected +
                                          ": are the two devices' addresses exchanged?");
  }
  if (line.heard_anything()) {
    return lose(Health::kWrongDevice, place() + ": what answers here is no SCIP (first bytes " +
                                          line.heard_text() + ")" + expected);
  }
  lose(Health::kSilent, place() + ": no answer" +
                            (line.stream().has_baud() ? " at 19200, 38400 and 115200 baud" : "") + expected +
                            ": is it powered?");
}

void Connection::Impl::on_find_reply() {
  const Reply& reply = line.reply();
  if (pending.sent.view() != "QT") return find_next();
  if (reply.scip1()) {
    if (pending.tries++ == kMaxTries) {
      return lose(Health::kWrongDevice,
                  place() + ": the sensor speaks SCIP 1.1 and does not switch; expected SCIP 2.0");
    }
    line_search.find_index = 0;  // the next request switches to SCIP 2.0
    return find_next();
  }
  // Refused in adjust mode: status 10, with some firmware 0D or 0E. TM2 is tried once; if it has no effect,
  // VV fails.
  const bool refused = reply.status() == "10" || reply.status() == "0E" || reply.status() == "0D";
  if (refused && pending.tries++ == 0) return enter(Phase::kLeaveAdjust, "TM2", kFindLimit);
  pending.tries = 0;
  enter_version();
}

void Connection::Impl::enter_version() { enter(Phase::kVersion, "VV", kAskLimit); }

void Connection::Impl::retry_version() {
  if (++pending.tries >= kMaxTries) {
    return lose(Health::kSilent, place() +
                                     ": the sensor stopped answering while it was asked for its identity (" +
                                     std::string(pending.sent.view()) + ")");
  }
  const RequestText again = pending.sent;
  enter(pending.phase, again.view(), kAskLimit);
}

void Connection::Impl::on_version() {
  if (auto read = read_version(line.reply(), found); !read) {
    if (++pending.tries < kMaxTries) return enter_version();
    return lose(unread(read.error()), place() + ": " + read.error().message);
  }
  if (!config.serial_number.empty() && !same_serial(config.serial_number, found.serial_number)) {
    return lose(Health::kWrongDevice, place() + ": the " + found.product + " here has the serial number " +
                                          found.serial_number + "; expected " + config.serial_number +
                                          ": are the sensors exchanged?");
  }
  pending.tries = 0;
  enter(Phase::kParameters, "PP", kAskLimit);
}

void Connection::Impl::on_parameters() {
  if (auto read = read_parameters(line.reply(), found); !read) {
    if (++pending.tries < kMaxTries) return enter(Phase::kParameters, "PP", kAskLimit);
    return lose(unread(read.error()), place() + ": " + read.error().message);
  }
  pending.tries = 0;
  enter(Phase::kState, "II", kAskLimit);
}

StreamRequest Connection::Impl::make_request() const {
  StreamRequest made;
  made.kind = stream.intensity ? StreamRequest::Kind::kRangeIntensity : StreamRequest::Kind::kRange;
  made.start = static_cast<std::uint16_t>(found.step_min);
  made.end = static_cast<std::uint16_t>(found.step_max);
  made.cluster = static_cast<std::uint8_t>(cluster_of(found));
  made.interval = static_cast<std::uint8_t>(std::clamp(config.skip_scans, 0, 9));
  // Intensities over a wide angle corrupt or crash a UTM-30LX on USB: at most 95 degrees per cluster unit,
  // 190 with firmware 1.16.01 (section 13).
  if (stream.intensity && stream.family == Family::kUtm)
    made.cluster = std::max<std::uint8_t>(made.cluster, found.firmware.starts_with("1.16.01") ? 2 : 3);
  return made;
}

/// Computes all constants of streaming once, from validated parameters.
void Connection::Impl::prepare_stream() {
  found.assumed = assumption(found);
  info = found;
  stream.family = family_of(found.product);
  stream.intensity = config.intensity && has_intensity(stream.family);
  stream.request = make_request();
  stream.decode = RangeDecoder(stream.family, found.distance_min_mm, found.distance_max_mm);

  const double turn_s = 60.0 / found.rpm;
  const double step_rad = 2.0 * std::numbers::pi / found.steps_per_turn;
  const double step_s = turn_s / found.steps_per_turn;
  const double period_s = turn_s * (stream.request.interval + 1);
  const double centre =
      stream.request.start + (stream.request.cluster - 1) / 2.0;  // of the first group of steps
  // The order of the beams stays that of their times.
  const double side = config.mirrored ? -1.0 : 1.0;
  stream.geometry.angle_min_rad = static_cast<float>(side * (centre - found.step_front) * step_rad);
  stream.geometry.angle_increment_rad = static_cast<float>(side * stream.request.cluster * step_rad);
  stream.geometry.time_increment_s = static_cast<float>(stream.request.cluster * step_s);
  stream.geometry.period_s = static_cast<float>(period_s);
  stream.geometry.range_min_m =
      static_cast<float>(std::max(found.distance_min_mm, RangeDecoder::kLeast_mm) * 1e-3);
  stream.geometry.range_max_m = static_cast<float>(found.distance_max_mm * 1e-3);
  mark_masked();
  stream.turn = types::from_seconds(turn_s);
  stream.first_offset = types::from_seconds(centre * step_s + config.stamp_offset_s);
  stream.silence_limit = std::max<Duration>(types::from_seconds(10.0 * period_s), 500ms);

  restart_stream();
}

void Connection::Impl::mark_masked() {
  stream.masked.reset();
  const types::ScanGeometry& g = stream.geometry;
  for (std::size_t i = 0; i < std::min(stream.request.points(), stream.masked.size()); ++i) {
    const double angle_rad = static_cast<double>(g.angle_min_rad) +
                             static_cast<double>(i) * static_cast<double>(g.angle_increment_rad);
    stream.masked[i] = config.masks.holds(angle_rad);
  }
}

/// Starts with the clock: TM is refused while the sensor measures.
void Connection::Impl::restart_stream() {
  // The sensor sends the data when the last step is measured (section 12).
  clock.reset(stream.turn * found.step_max / found.steps_per_turn);
  last_device_ms.reset();
  samples = 0;
  pending.tries = 0;
  // The message of the last failure stays until a scan proves it cured.
  const bool was_late = std::exchange(faults.clock_in_doubt, false);
  if (!was_late && !faults.faulty &&
      (retry.failures == 0 || verdict.health == Health::kDisconnected ||
       verdict.health == Health::kWrongDevice)) {
    set_health(Health::kStarting,
               place() + ": " + found.product + " " + found.serial_number + " is starting");
  }
  enter(Phase::kAdjust, "TM0", kClockLimit);
}

void Connection::Impl::on_adjust_reply() {
  if (is_good(line.reply().status())) return enter(Phase::kSample, "TM1", kClockLimit);
  enter(Phase::kAdjusted, "TM2", 300ms);  // no clock by TM: the assumed latency is used
}

void Connection::Impl::on_sample() {
  const auto time = read_time(line.reply());
  if (time) clock.add_round_trip(*time, pending.asked, line.arrival());
  if (++samples < kSamples) return enter(Phase::kSample, "TM1", kClockLimit);
  enter(Phase::kAdjusted, "TM2", 300ms);
}

void Connection::Impl::enter_laser() {
  pending.tries = 0;
  laser_deadline = now() + kSpinUpLimit;
  enter(Phase::kLaser, "BM", 500ms);
}

void Connection::Impl::on_laser_reply() {
  if (!is_good(line.reply().status())) return retry_laser();
  enter(Phase::kStart, encode(stream.request).view(), stream.silence_limit);
}

/// The first BM after power-up fails while the motor spins up (section 13).
void Connection::Impl::retry_laser() {
  if (now() < laser_deadline) {
    pending.phase = Phase::kLaserPause;
    pending.deadline = now() + kLaserPause;
    return;
  }
  const bool answered = line.reply().echo() == "BM";
  std::string why = place() + ": the laser does not switch on within 10 s (";
  if (answered)
    why.append("BM: status ")
        .append(line.reply().status())
        .append(", ")
        .append(describe_status(line.reply().status()));
  if (!answered) why += "no answer to BM";
  lose(Health::kFault, why + "; the sensor says \"" + found.status + "\"): switch its power off and on");
}

void Connection::Impl::on_start_reply() {
  const std::string_view status = line.reply().status();
  if (status == "00") {
    pending.phase = Phase::kStreaming;
    pending.deadline = now() + stream.silence_limit;
    return;
  }
  const std::string what = place() + ": " + std::string(pending.sent.view()) + " is answered with status " +
                           std::string(status) + ", " + std::string(describe_status(status));
  if (stream.intensity && status.front() == '0') {  // a firmware without intensities
    stream.intensity = false;
    stream.request = make_request();
    return enter(Phase::kStart, encode(stream.request).view(), stream.silence_limit);
  }
  // A request that it does not take is no fault of the sensor.
  const bool refused = status.size() == 2 && status.front() == '0' && status != "0L";
  faults.faulty = !refused;
  set_health(refused ? Health::kUnusable : Health::kFault, what);
  probe();
}

}  // namespace topo::hokuyo
