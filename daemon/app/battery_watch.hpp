// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "core/types/battery.hpp"

namespace topo::daemon {

/// Decides when a low battery is reported: once, and again after it was charged.
class BatteryWatch {
 public:
  /// An unloaded battery recovers for a moment; one that is not low for this long was charged.
  static constexpr types::Duration kChargedAfter = std::chrono::minutes(1);

  /// To be called for every reading; true when the low battery is to be reported now.
  bool note(bool low, types::Stamp now) {
    if (low != low_ || !since_) since_ = now;
    low_ = low;
    if (!low && now - *since_ >= kChargedAfter) told_ = false;
    if (!low || told_ || now - *since_ < types::kBatteryLowFor) return false;
    told_ = true;
    return true;
  }

 private:
  bool low_ = false;
  bool told_ = false;
  std::optional<types::Stamp> since_;  ///< start of the current state of `low_`
};

}  // namespace topo::daemon
