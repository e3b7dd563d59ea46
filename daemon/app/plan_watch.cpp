// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/app/plan_watch.hpp"

#include <algorithm>

namespace topo::daemon {

void PlanWatch::update() {
  report_ = reports_.pin();
  if (!report_) return;
  types::Stamp newest = passed_;
  for (const pipeline::Decision& decision : report_->decisions) {
    if (decision.stamp <= passed_) continue;
    newest = std::max(newest, decision.stamp);
    on_decision_(decision);
  }
  passed_ = newest;
}

}  // namespace topo::daemon
