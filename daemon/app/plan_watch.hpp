// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <utility>

#include "daemon/threads/hand_overs.hpp"

namespace topo::daemon {

/// Main's reader of planning's reports: pins the newest one, and passes on every decision once. Main only.
class PlanWatch {
 public:
  using OnDecision = std::function<void(const pipeline::Decision& decision)>;
  PlanWatch(HandOvers& hand_overs, OnDecision on_decision)
      : reports_(hand_overs.planning->reader(kMainReader)), on_decision_(std::move(on_decision)) {}

  /// Takes the newest report; to be called periodically.
  void update();

  /// Null before the first report. Valid until the next update().
  [[nodiscard]] const pipeline::PlanningReport* report() const { return report_.get(); }

 private:
  PlanningReports::Reader reports_;
  PlanningReports::Pin report_;
  OnDecision on_decision_;
  types::Stamp passed_{};  ///< of the newest decision that was passed on
};

}  // namespace topo::daemon
