// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/app/plan_watch.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>

namespace topo::daemon {

void PlanWatch::update() {
  report_ = reports_.pin();
  if (!report_) return;
  types::Stamp newest = logged_;
  for (const pipeline::Decision& decision : report_->decisions) {
    if (decision.stamp <= logged_) continue;
    newest = std::max(newest, decision.stamp);
    spdlog::info("goal ({:.2f}, {:.2f}): {}", decision.p_map.x(), decision.p_map.y(), decision.text);
  }
  logged_ = newest;
}

}  // namespace topo::daemon
