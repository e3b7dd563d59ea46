// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/threads/base_worker.hpp"

#include <algorithm>
#include <utility>

#include "daemon/logging/event_catalogue.hpp"
#include "daemon/threads/device_report.hpp"
#include "drivers/io/posix.hpp"

namespace topo::daemon {
BaseWorker::BaseWorker(HandOvers& hand_overs, const pipeline::ControlSetup& setup,
                       const pipeline::ControlParams& params, std::unique_ptr<pioneer::Connection> connection,
                       Vitals& vitals)
    : hand_overs_(hand_overs),
      connection_(std::move(connection)),
      vitals_(vitals),
      setup_(setup),
      control_(params, setup.disobeyed) {
  connection_->set_silence(setup.disobeyed);  // before its first byte
}

void BaseWorker::run() noexcept {
  Period period(io::monotonic_now() + kPeriod, kPeriod);
  while (!hand_overs_.ending.devices_closing.load(std::memory_order_acquire)) {
    const types::Stamp due = period.next();
    serve_until(due);
    const types::Stamp woken = io::monotonic_now();
    vitals_.wake.record((woken - due).count());
    decide();
    report();
    const types::Stamp done = io::monotonic_now();
    vitals_.run.record((done - woken).count());
    if (const std::uint64_t missed = period.advance(done); missed > 0) {
      vitals_.add_overruns(missed);
      post(vitals_.events, done.time_since_epoch().count(), EventId::kDeadlineMissed,
           sync::Severity::kWarning, {(woken - due).count(), static_cast<std::int64_t>(missed)});
    }
    vitals_.beat();
  }
  connection_->close(kCloseTime);
  report();
}

void BaseWorker::serve_until(types::Stamp deadline) {
  while (true) {
    const types::Stamp now = io::monotonic_now();
    if (now >= deadline) return;
    if (connection_->step(incoming_, deadline - now) == pioneer::StepOutcome::kState) take_state();
  }
}

void BaseWorker::take_state() {
  state_ = incoming_;
  has_state_ = true;
  if (types::Odometry* slot = hand_overs_.base.odometry.try_acquire(); slot != nullptr) {
    *slot = state_.odometry;
    hand_overs_.base.odometry.commit();
    hand_overs_.mapping.wakeup.post();
  }
}

pipeline::ControlInput BaseWorker::gather() {
  pipeline::ControlInput input;
  input.now = io::monotonic_now();
  const sync::EStopLine<>::Reading estop = hand_overs_.estop.read();
  input.estop = estop.pressed;
  input.estop_cleared = estop.cleared;
  input.teleop = hand_overs_.drive.read();
  input.plan = hand_overs_.plan.read();
  input.front = hand_overs_.front.to_base.read();
  input.matched = hand_overs_.mapping.to_base.read();
  input.base_released = connection_->releases() != std::exchange(releases_, connection_->releases());
  input.place = hand_overs_.place.now();
  input.area = hand_overs_.area.read();
  const bool ready = pioneer::takes_commands(connection_->health());
  has_state_ = has_state_ && ready;  // a new connection is not judged by the last status of the one before
  input.state = has_state_ ? &state_ : nullptr;
  if (const auto& info = connection_->info(); info) {
    input.firmware_watchdog = std::chrono::milliseconds(info->watchdog_ms);
    input.watchdog_on_trial = connection_->health() == pioneer::Health::kOnTrial;
    input.firmware_deceleration_mps2 = info->deceleration_top_mps2;
    input.T_base_sonar = {info->T_base_sonar.data(), std::min(info->sonars, info->T_base_sonar.size())};
  }
  return input;
}

void BaseWorker::decide() {
  const pipeline::ControlOutput output = pipeline::control_step(control_, setup_, gather());
  control_report_ = output.report;
  connection_->set_silence(output.command.silence);
  // A command that cannot be sent shows in the connection's health; without commands the connection stops the
  // base.
  if (pioneer::takes_commands(connection_->health())) (void)connection_->command(output.command);
}

void BaseWorker::report() {
  fill_report(hand_overs_.base.device.writable(), *connection_);
  hand_overs_.base.device.publish();
  BaseReport& report = hand_overs_.base.report.writable();
  report.state = state_;
  report.ready = pioneer::takes_commands(connection_->health());
  report.control = control_report_;
  hand_overs_.base.report.publish();
  hand_overs_.to_planning.control.store(control_report_);
}

}  // namespace topo::daemon
