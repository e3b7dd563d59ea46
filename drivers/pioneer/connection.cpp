// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/pioneer/connection.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "drivers/pioneer/dead_reckoning.hpp"
#include "drivers/pioneer/drive.hpp"
#include "drivers/pioneer/gyro.hpp"
#include "drivers/pioneer/handshake.hpp"
#include "drivers/pioneer/link.hpp"
#include "drivers/pioneer/listening.hpp"
#include "drivers/pioneer/robot_info.hpp"
#include "drivers/pioneer/round_trip.hpp"
#include "drivers/pioneer/sip.hpp"
#include "drivers/pioneer/sip_delay.hpp"

namespace topo::pioneer {
namespace {

using std::chrono::milliseconds;
using types::Duration;
using types::Stamp;

constexpr Duration kBackOffMin = milliseconds(500);
constexpr Duration kBackOffMax = milliseconds(5000);
constexpr int kSilentCycles = 5;
constexpr unsigned kGyroFault = 1U << 4U;  ///< of FAULTFLAGS (PROTOCOLS section 4)

types::Twist2 true_twist(const types::Twist2& counted, const types::WheelCalibration& wheels,
                         double model_track_m) {
  const types::Progress p = types::true_progress(wheels, model_track_m, {counted.v_mps, counted.omega_radps});
  return {p.way_m, p.turn_rad};
}

}  // namespace

/// Way and heading of the robot.
struct Reckoning {
  DeadReckoning wheels;
  Gyro gyro;
};

struct Connection::Impl {
  /// What the connection reports of itself.
  struct Verdict {
    Health health = Health::kDisconnected;
    std::string message = "not connected yet";
    bool changed = false;  ///< since the caller's last look
  };

  /// The next attempt to reach the robot.
  struct Retry {
    int good_baud = 0;  ///< at which the base answered last; 0: none yet
    bool first_attempt = true;
    Handshake::Opening opening = Handshake::Opening::kFull;
    std::string measured{};  ///< name and subclass of the robot whose watchdog was measured
    Duration back_off = kBackOffMin;
    Stamp retry_at{};
    Stamp
        may_drive_until{};  ///< until the watchdog expires, a setpoint of the lost connection may be in force
  };

  /// The base does not obey: every byte would feed its watchdog.
  struct Silence {
    bool binds = false;
    std::uint64_t releases = 0;
  };

  Impl(ConnectionConfig connection_config, std::unique_ptr<io::Connector> connection_connector)
      : config(std::move(connection_config)), connector(std::move(connection_connector)) {}

  StepOutcome step(types::BaseState& out, Duration timeout);
  types::Status command(const types::BaseCommand& command);
  void close(Duration timeout);

  [[nodiscard]] Stamp now() const { return link ? link->now() : connector->now(); }
  [[nodiscard]] std::string device() const { return std::string(connector->name()); }
  void set_health(Health value, std::string text);
  void lose(Health value, std::string text);
  void open(Duration timeout);
  void connect_further(Stamp deadline);
  void begin_listening();
  void listen_further(Stamp deadline);
  void begin_handshake();
  void set_silence(bool silence);
  void release();
  void advance(Handshake::Progress progress);
  void start_running();
  [[nodiscard]] std::string robot() const;
  void tell_ready();
  void tell_trial(const ConfigAnswer& answer);
  void judge_trial();
  bool run(types::BaseState& out, Stamp deadline);
  bool on_packet(const PacketView& packet, types::BaseState& out);
  bool on_status(const PacketView& packet, types::BaseState& out);
  bool exchange(Stamp until);
  void drain(Stamp until, bool until_standstill);

  ConnectionConfig config;
  std::unique_ptr<io::Connector> connector;
  Verdict verdict;
  bool closed = false;
  std::optional<RobotInfo> info;
  Counters counters;
  Retry retry;

  Silence silence;

  std::optional<Link> link;
  std::optional<Listening> listening;
  std::optional<Handshake> handshake;
  std::optional<Drive> drive;
  std::optional<SipDelay> delay;
  RoundTrip trip;
  RobotModel model;
  Reckoning reckoning;
  types::BaseState state;
  Stamp last_status{};  ///< arrival, or the start of running
};

void Connection::Impl::set_health(Health value, std::string text) {
  if (verdict.health == value && verdict.message == text) return;
  verdict.health = value;
  verdict.message = std::move(text);
  verdict.changed = true;
}

/// Closes the line and waits before the next attempt; sends a last E_STOP if possible and allowed.
void Connection::Impl::lose(Health value, std::string text) {
  const Stamp time = now();
  if (link && drive) {
    if (!silence.binds) std::ignore = link->send_at_once(encode(Command::kEStop));
    // A controller that was reset holds no setpoint.
    if (drive->may_be_moving() && value != Health::kReset)
      retry.may_drive_until = time + milliseconds(info->watchdog_ms);
  }
  const bool refused = handshake && handshake->opening_refused(value == Health::kDisconnected);
  retry.opening = refused ? Handshake::Opening::kSyncAlone : Handshake::Opening::kFull;
  if (refused) retry.back_off = kBackOffMin;
  drive.reset();
  handshake.reset();
  listening.reset();
  link.reset();
  retry.retry_at = time + retry.back_off;
  retry.back_off = std::min(retry.back_off * 2, kBackOffMax);
  set_health(value, std::move(text));
}

void Connection::Impl::open(Duration timeout) {
  auto stream = connector->connect(timeout);
  if (!stream && stream.error().code == types::Errc::kTimeout) {
    // The attempt continues in the connector; the next call resumes it.
    set_health(Health::kDisconnected, stream.error().message);
    return;
  }
  if (!stream) {
    lose(Health::kDisconnected, stream.error().message);
    return;
  }
  link.emplace(std::move(*stream), counters);
  silence.binds ? begin_listening() : begin_handshake();
}

void Connection::Impl::begin_handshake() {
  listening.reset();
  ExpectedRobot expected{config.expected_chassis, config.expected_name, config.expected_serial_number,
                         config.family};
  handshake.emplace(*link, std::move(expected), connector->name(), retry.good_baud, retry.may_drive_until,
                    retry.opening);
  if (auto begun = handshake->begin(); !begun) {
    lose(Health::kDisconnected, begun.error().message);
    return;
  }
  // After a failure its message stays until the robot answers, so that the state of a device that is off does
  // not alternate.
  if (std::exchange(retry.first_attempt, false))
    set_health(Health::kConnecting, device() + ": looking for the robot");
}

void Connection::Impl::begin_listening() {
  handshake.reset();
  listening.emplace(*link, retry.good_baud);
  retry.first_attempt = false;
  set_health(Health::kUnsafe,
             device() +
                 ": the robot did not obey: nothing is sent to it, so that its own watchdog stops it; "
                 "press its stop button, or reset its controller, or say topoctl clear-estop while "
                 "it stands");
}

/// Nothing is sent until the robot is released.
void Connection::Impl::listen_further(Stamp deadline) {
  if (!silence.binds) return begin_handshake();
  if (const auto packet = link->next_packet()) {
    if (listening->on_packet(*packet) == Listening::Heard::kReleased) release();
    return;
  }
  auto done = listening->on_time();
  if (done) done = link->receive(std::min(deadline, listening->deadline()) - link->now());
  if (!done) lose(Health::kDisconnected, device() + ": " + done.error().message);
}

void Connection::Impl::set_silence(bool binds) {
  silence.binds = binds;
  if (binds && handshake) begin_listening();
}

void Connection::Impl::release() {
  silence.binds = false;
  ++silence.releases;
}

/// Sends due commands and reads once, at most until `until`. False when the line is lost.
bool Connection::Impl::exchange(Stamp until) {
  auto sent = link->pump();
  if (sent) sent = link->receive(std::min(until, link->next_send()) - link->now());
  if (!sent) lose(Health::kDisconnected, device() + ": " + sent.error().message);
  return sent.has_value();
}

void Connection::Impl::connect_further(Stamp deadline) {
  if (const auto packet = link->next_packet()) {
    advance(handshake->on_packet(*packet));
    return;
  }
  const auto progress = handshake->on_time();
  if (progress != Handshake::Progress::kPending) return advance(progress);
  exchange(std::min(deadline, handshake->deadline()));
}

void Connection::Impl::advance(Handshake::Progress progress) {
  if (progress == Handshake::Progress::kFailed) {
    // The robot may be in SYNC or have an open connection: it is closed.
    if (handshake->heard_robot()) std::ignore = link->send_at_once(encode(Command::kClose, 1));
    return lose(handshake->failure(), handshake->message());
  }
  if (handshake->heard_robot() && verdict.health != Health::kConnecting)
    set_health(Health::kConnecting, device() + ": the robot answers");
  if (progress == Handshake::Progress::kDone) start_running();
}

void Connection::Impl::start_running() {
  const ConfigAnswer answer = handshake->config();
  model = handshake->model();
  if (info) ++counters.reconnects;
  info = make_robot_info(handshake->name(), handshake->subclass(), model, answer, config.watchdog_ms);
  if (info->watchdog == WatchdogSource::kGiven && retry.measured == robot())
    info->watchdog = WatchdogSource::kMeasured;
  retry.good_baud = handshake->baud();
  handshake.reset();
  retry.back_off = kBackOffMin;
  const std::string fault = watchdog_fault(answer, config.watchdog_ms);
  drive.emplace(link->outbox(), drive_limits(config, *info, answer.packet), config.sonar, fault.empty(),
                now());
  if (info->watchdog == WatchdogSource::kGiven)
    drive->put_on_trial({.given = milliseconds(info->watchdog_ms)});
  delay.emplace(milliseconds(info->sip_cycle_ms));
  trip = {};
  // Physical limits instead of the configured ones: a push must not be taken for a reset of the controller.
  constexpr double kPushed = 2.0;
  reckoning.wheels.restart(model, kPushed * model.size.v_max_mps, kPushed * model.size.omega_max_radps,
                           config.wheels);
  reckoning.gyro = Gyro();
  if (answer.packet && answer.packet->has_gyro == 1 && config.gyro)
    link->outbox().push(encode(Command::kGyro, 1));
  last_status = now();
  if (!fault.empty()) return set_health(Health::kUnsafe, device() + ": " + robot() + ": " + fault);
  info->watchdog == WatchdogSource::kGiven ? tell_trial(answer) : tell_ready();
}

std::string Connection::Impl::robot() const { return info->subclass + " \"" + info->name + "\""; }

void Connection::Impl::tell_ready() {
  const char* const source =
      info->watchdog == WatchdogSource::kMeasured ? " (base.watchdog_ms, measured)" : "";
  set_health(Health::kReady, device() + ": " + robot() + ", serial number " + info->serial_number +
                                 ", firmware " + info->firmware + ", watchdog " +
                                 std::to_string(info->watchdog_ms) + " ms" + source);
}

void Connection::Impl::tell_trial(const ConfigAnswer& answer) {
  const std::string why = answer.packet        ? "tells no watchdog"
                          : answer.damaged > 0 ? "sends damaged CONFIG packets"
                                               : "sends no CONFIG packet";
  set_health(Health::kOnTrial, device() + ": " + robot() + " " + why +
                                   "; base.watchdog_ms = " + std::to_string(info->watchdog_ms) +
                                   " is measured with the first turn on the spot by hand: topoctl drive 0 "
                                   "0.2 --for 5");
}

/// The trial's result becomes the connection's health.
void Connection::Impl::judge_trial() {
  if (verdict.health != Health::kOnTrial || !drive->trial()) return;
  const WatchdogTrial& trial = *drive->trial();
  if (trial.result() == WatchdogTrial::Result::kPassed) {
    info->watchdog = WatchdogSource::kMeasured;
    retry.measured = robot();
    tell_ready();
  } else if (trial.result() == WatchdogTrial::Result::kFailed) {
    set_health(Health::kUnsafe,
               device() + ": " + robot() + ": the wheels turned on " + std::to_string(info->watchdog_ms) +
                   " ms and more after the last packet (base.watchdog_ms): driving is refused until "
                   "WatchDog in its FLASH is on");
  }
}

bool Connection::Impl::on_status(const PacketView& packet, types::BaseState& out) {
  const auto status = decode_status(packet.payload);
  if (!status) {
    ++counters.bad_packets;
    return false;
  }
  const Stamp arrival = packet.last_byte;
  const Duration cycle = milliseconds(info->sip_cycle_ms);
  const Duration age = delay->update(arrival, link->wire_time(packet.wire_bytes()));
  const bool gyro_fault = (status->fault_flags.value_or(0) & kGyroFault) != 0;
  const auto turn =
      reckoning.gyro.turn_rad(delay->last_step() * cycle, reckoning.wheels.stands(*status), gyro_fault);
  reckoning.wheels.update(*status, std::max(arrival - last_status, cycle), turn);
  last_status = arrival;
  state.late = delay->late();
  state.round_trip = trip.trip();
  apply_status(*status, model, arrival, state);
  // Strictly later than the previous stamp: two poses of one instant have no velocity between them.
  state.odometry.stamp =
      std::max(arrival - age - config.status_delay, state.odometry.stamp + std::chrono::microseconds(1));
  state.odometry.T_odom_base = types::Transform2<types::Odom, types::Base>(reckoning.wheels.T_odom_base());
  state.odometry.twist = true_twist(measured_twist(*status, model), config.wheels, info->track_m);
  state.sequence = ++counters.status_packets;
  counters.lost_packets += static_cast<std::uint64_t>(delay->last_step() - 1);
  drive->on_state(state, arrival);
  judge_trial();
  out = state;
  return true;
}

bool Connection::Impl::on_packet(const PacketView& packet, types::BaseState& out) {
  if (packet.is(PacketType::kReset) || packet.is(PacketType::kResetWithDiagnosis)) {
    release();
    lose(Health::kReset, device() + ": the robot's controller was reset; connecting again");
    return false;
  }
  if (packet.is(PacketType::kEncoder)) {
    trip.left(link->last_request());
    trip.answered(link->heard_after());
  }
  if (packet.is(PacketType::kGyro))
    if (const auto readings = decode_gyro(packet.payload)) reckoning.gyro.take(*readings);
  return packet.is_status() && on_status(packet, out);
}

/// Handles one packet, or exchanges bytes once. True when `out` is new.
bool Connection::Impl::run(types::BaseState& out, Stamp deadline) {
  if (const auto packet = link->next_packet()) return on_packet(*packet, out);
  // Evaluated only after a read that began after the limit: a thread that was delayed finds its packets
  // waiting.
  const Stamp silent_at = last_status + kSilentCycles * milliseconds(info->sip_cycle_ms);
  if (link->last_read() >= silent_at) {
    lose(Health::kSilent, device() + ": no status from the robot for " + std::to_string(kSilentCycles) +
                              " cycles; connecting again");
    return false;
  }
  trip.expire(link->last_read());
  if (!drive->is_silent() && trip.is_due(link->now()) && link->outbox().push(encode(Command::kEncoder, 1)))
    trip.asked(link->now());
  drive->keep_alive(link->now(), link->last_send());
  judge_trial();
  exchange(std::min({deadline, silent_at, drive->next_due(link->last_send())}));
  return false;
}

StepOutcome Connection::Impl::step(types::BaseState& out, Duration timeout) {
  const Stamp deadline = now() + timeout;
  do {
    if (std::exchange(verdict.changed, false)) return StepOutcome::kChanged;
    if (closed || (!link && now() < retry.retry_at)) {
      const Stamp until = closed ? deadline : std::min(deadline, retry.retry_at);
      connector->pause(until - now());
    } else if (!link) {
      open(std::max(deadline - now(), Duration::zero()));
    } else if (listening) {
      listen_further(deadline);
    } else if (handshake) {
      connect_further(deadline);
    } else if (run(out, deadline)) {
      return StepOutcome::kState;
    }
  } while (now() < deadline);
  return std::exchange(verdict.changed, false) ? StepOutcome::kChanged : StepOutcome::kNothing;
}

types::Status Connection::Impl::command(const types::BaseCommand& command) {
  set_silence(command.silence);
  if (!drive) return types::fail(types::Errc::kClosed, "not connected");  // short: no allocation
  auto result = drive->command(command, link->now());
  // An error of the line is handled in step(), which closes the line.
  if (auto sent = link->pump(); !sent) return sent;
  return result;
}

void Connection::Impl::drain(Stamp until, bool until_standstill) {
  types::BaseState ignored;
  while (link && drive && now() < until) {
    if (link->all_sent() && (!until_standstill || drive->stands())) return;
    if (const auto packet = link->next_packet())
      on_packet(*packet, ignored);
    else
      exchange(until);
  }
}

void Connection::Impl::close(Duration timeout) {
  if (closed) return;
  const Stamp end = now() + timeout;
  if (silence.binds) {
    drive.reset();
    handshake.reset();
  } else if (link && drive) {
    Outbox& out = link->outbox();
    drive->shut_down();
    link->clear();
    out.set_estop();
    out.push(encode(Command::kVel, 0));
    out.push(encode(Command::kRvel, 0));
    drain(end - timeout / 3, true);  // a robot without motors does not brake: it must stand first
  }
  if (link && drive) {
    link->outbox().push(encode(Command::kEnable, 0));
    link->outbox().push(encode(Command::kClose, 1));
    drain(end, false);
  } else if (link && !silence.binds) {
    std::ignore = link->send_at_once(encode(Command::kClose, 1));
  }
  drive.reset();
  handshake.reset();
  listening.reset();
  link.reset();
  closed = true;
  set_health(Health::kDisconnected, device() + ": closed");
}

Connection::Connection(ConnectionConfig config, std::unique_ptr<io::Connector> connector)
    : impl_(std::make_unique<Impl>(std::move(config), std::move(connector))) {}
Connection::~Connection() { close(milliseconds(300)); }

StepOutcome Connection::step(types::BaseState& out, types::Duration timeout) {
  return impl_->step(out, timeout);
}
types::Status Connection::command(const types::BaseCommand& command) { return impl_->command(command); }
void Connection::set_silence(bool silence) { impl_->set_silence(silence); }
std::uint64_t Connection::releases() const { return impl_->silence.releases; }
void Connection::close(types::Duration timeout) { impl_->close(timeout); }
Health Connection::health() const { return impl_->verdict.health; }
const std::string& Connection::message() const { return impl_->verdict.message; }
const std::optional<RobotInfo>& Connection::info() const { return impl_->info; }
const Counters& Connection::counters() const { return impl_->counters; }

}  // namespace topo::pioneer
