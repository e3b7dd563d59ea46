// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/pipeline/plan.hpp"

namespace topo::pipeline {

std::string_view to_text(Activity activity) {
  switch (activity) {
    case Activity::kIdle:
      return "idle";
    case Activity::kExploring:
      return "exploring";
    case Activity::kThinking:
      return "thinking";
    case Activity::kGoingTo:
      return "going";
    case Activity::kReturning:
      return "returning";
    case Activity::kPaused:
      return "paused";
    case Activity::kDone:
      return "done";
    case Activity::kFailed:
      return "failed";
  }
  return "unknown";
}

}  // namespace topo::pipeline
