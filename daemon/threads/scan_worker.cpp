// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/threads/scan_worker.hpp"

#include "daemon/logging/event_catalogue.hpp"
#include "daemon/threads/device_report.hpp"
#include "drivers/io/posix.hpp"

namespace topo::daemon {

ScanWorker::ScanWorker(HandOvers& hand_overs, ScanHandOver& out, bool front,
                       std::unique_ptr<hokuyo::Connection> connection, Vitals& vitals)
    : hand_overs_(hand_overs),
      out_(out),
      front_(front),
      connection_(std::move(connection)),
      vitals_(vitals) {}

void ScanWorker::run() noexcept {
  while (!hand_overs_.ending.devices_closing.load(std::memory_order_acquire)) {
    // Paced by the sensor, or by the time-out: a connection returns earlier only with a scan or a change.
    const hokuyo::StepOutcome outcome = step();
    vitals_.beat();
    if (outcome == hokuyo::StepOutcome::kChanged || io::monotonic_now() >= next_report_) report();
  }
  connection_->close(kCloseTime);
  report();
}

hokuyo::StepOutcome ScanWorker::step() {
  // When the ring is full the sensor is still read, so that the base gets scans and the line does not
  // overflow.
  types::Scan* slot = out_.to_mapping.next_free();
  types::Scan& scan = slot != nullptr ? *slot : *spare_;
  const hokuyo::StepOutcome outcome = connection_->step(scan, kTimeout);
  if (outcome != hokuyo::StepOutcome::kScan) return outcome;
  const types::Stamp woken = io::monotonic_now();
  vitals_.wake.record((woken - scan.arrival).count());
  if (front_) {
    out_.to_base.store(scan);
    out_.to_planning.store(scan);
    out_.to_main.store(scan);
  }
  if (slot != nullptr) {
    out_.to_mapping.commit();
    hand_overs_.mapping.wakeup.post();
  } else {
    out_.to_mapping.reject();
  }
  note_ring_full(slot == nullptr);
  vitals_.run.record((io::monotonic_now() - woken).count());
  return outcome;
}

void ScanWorker::note_ring_full(bool full) {
  if (full && !ring_full_) {
    post(vitals_.events, io::monotonic_now().time_since_epoch().count(), EventId::kScanRingFull,
         sync::Severity::kWarning, {static_cast<std::int64_t>(out_.to_mapping.rejected())}, vitals_.name);
  }
  ring_full_ = full;
}

void ScanWorker::report() {
  fill_report(out_.report.writable(), *connection_);
  out_.report.publish();
  next_report_ = io::monotonic_now() + std::chrono::milliseconds(200);
}

}  // namespace topo::daemon
