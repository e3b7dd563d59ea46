// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/setup/device_probe.hpp"

#include <utility>

#include "drivers/io/make_connector.hpp"
#include "drivers/pioneer/base_connector.hpp"
#include "drivers/pioneer/robot_models.hpp"

namespace topo::daemon {
namespace {

constexpr types::Duration kBaseCloseLimit = std::chrono::milliseconds(300);
/// Ten pictures a second are enough, and leave room on slow lines and in this loop.
constexpr int kSkipScans = 3;
/// Its factors do not matter to a base that is only asked who it is.
constexpr const char* kAnyFamily = "p3dx-sh";

}  // namespace

DeviceProbe::DeviceProbe(SearchPlace place) : place_(std::move(place)) {
  place_.base_only ? begin_base(Phase::kBase, "") : begin_scanner();
}

void DeviceProbe::begin_scanner() {
  auto connector = io::make_connector(place_.address);
  if (!connector) return end(connector.error().message, true);
  hokuyo::ConnectionConfig config;
  config.skip_scans = kSkipScans;
  as_scanner_ = std::make_unique<hokuyo::Connection>(config, std::move(*connector));
}

void DeviceProbe::begin_base(Phase phase, const char* family) {
  phase_ = phase;
  as_scanner_.reset();
  as_base_.reset();
  auto connector = pioneer::make_base_connector(place_.address);
  if (!connector) return end(connector.error().message, true);
  pioneer::ConnectionConfig config;
  config.family = family;
  config.sonar = false;
  as_base_ = std::make_unique<pioneer::Connection>(config, std::move(*connector));
}

void DeviceProbe::step(types::Scan& scratch, types::Duration timeout) {
  if (phase_ == Phase::kScanner)
    step_scanner(scratch, timeout);
  else if (phase_ != Phase::kDone)
    step_base(timeout);
}

void DeviceProbe::step_scanner(types::Scan& scratch, types::Duration timeout) {
  using hokuyo::Health;
  const auto outcome = as_scanner_->step(scratch, timeout);
  if (outcome == hokuyo::StepOutcome::kScan && as_scanner_->info()) {
    const hokuyo::SensorInfo& info = *as_scanner_->info();
    scanner_ = FoundScanner{place_.address, info.product, info.serial_number};
    phase_ = Phase::kDone;
    return;
  }
  if (outcome != hokuyo::StepOutcome::kChanged) return;
  const std::string said = as_scanner_->message();
  switch (as_scanner_->health()) {
    case Health::kWrongDevice:
    case Health::kSilent:
      return begin_base(Phase::kBase, "");
    case Health::kDisconnected:
      return end(said, place_.address.starts_with("serial:"));
    case Health::kDamaged:
    case Health::kUnusable:
    case Health::kFault:
      return end(said, true);
    default:
      return;
  }
}

void DeviceProbe::step_base(types::Duration timeout) {
  using pioneer::Health;
  types::BaseState state;
  const auto outcome = as_base_->step(state, timeout);
  if (outcome == pioneer::StepOutcome::kState && as_base_->info()) return found_base();
  if (outcome != pioneer::StepOutcome::kChanged) return;
  switch (as_base_->health()) {
    case Health::kWrongDevice:
      // Perhaps a base whose subclass names no family.
      if (phase_ == Phase::kBase) return begin_base(Phase::kNamelessBase, kAnyFamily);
      return end(as_base_->message(), true);
    case Health::kSilent:
      return end(as_base_->message(), false);
    case Health::kDisconnected:
    case Health::kRefuses:
    case Health::kUnidentified:
      return end(as_base_->message(), true);
    default:
      return;
  }
}

void DeviceProbe::found_base() {
  const pioneer::RobotInfo& info = *as_base_->info();
  const pioneer::RobotModel* family = pioneer::find_family(info.subclass);
  base_ = FoundBase{place_.address,
                    info.name,
                    info.subclass,
                    info.serial_number,
                    family == nullptr ? std::string() : std::string(family->chassis),
                    info.watchdog_ms};
  as_base_->close(kBaseCloseLimit);
  as_base_.reset();
  phase_ = Phase::kDone;
}

void DeviceProbe::end(std::string said, bool notable) {
  said_ = std::move(said);
  notable_ = notable;
  as_scanner_.reset();
  as_base_.reset();
  phase_ = Phase::kDone;
}

}  // namespace topo::daemon
