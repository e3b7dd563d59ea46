// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "daemon/threads/hand_overs.hpp"

namespace topo::daemon {

/// Main's reader of planning's reports: pins the newest one, and logs every decision once. Main only.
class PlanWatch {
 public:
  explicit PlanWatch(HandOvers& hand_overs) : reports_(hand_overs.planning->reader(kMainReader)) {}

  /// Takes the newest report; to be called periodically.
  void update();

  /// Null before the first report. Valid until the next update().
  [[nodiscard]] const pipeline::PlanningReport* report() const { return report_.get(); }

 private:
  PlanningReports::Reader reports_;
  PlanningReports::Pin report_;
  types::Stamp logged_{};  ///< of the newest logged decision
};

}  // namespace topo::daemon
