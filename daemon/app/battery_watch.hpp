// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "core/types/battery.hpp"

namespace topo::daemon {

/// When people are told that the battery is low: once, and again when it was charged in between.
class BatteryWatch {
 public:
  /// A battery that is spared recovers for a moment; one that is not low for so long was charged.
  static constexpr types::Duration kChargedAfter = std::chrono::minutes(1);

  /// At every reading; whether to tell it now.
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
  std::optional<types::Stamp> since_;  ///< it is as `low_` says
};

}  // namespace topo::daemon
