// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "core/types/stamp.hpp"

namespace topo::daemon {

/// A rate with a burst: `burst` tokens at first, one more every `period` up to `burst`. Pure: the time is a
/// parameter, which never decreases.
class TokenBucket {
 public:
  TokenBucket(types::Duration period, int burst) : period_(period), burst_(burst) {}

  /// Takes a token when there is one.
  [[nodiscard]] bool take(types::Stamp now) {
    if (now < next_at(now)) return false;
    // The stamp at which the bucket is full again says how many tokens are missing.
    full_at_ = std::max(full_at_, now) + period_;
    return true;
  }
  /// From when on a token can be taken.
  [[nodiscard]] types::Stamp next_at(types::Stamp now) const {
    return std::max(now, full_at_ - (burst_ - 1) * period_);
  }
  [[nodiscard]] bool is_full(types::Stamp now) const { return full_at_ <= now; }

 private:
  types::Duration period_;
  int burst_;
  types::Stamp full_at_{};
};

}  // namespace topo::daemon
