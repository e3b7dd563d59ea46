// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include "core/types/stamp.hpp"
#include "core/types/transform.hpp"

namespace topo::plausibility {

/// Commands of the last seconds, one a control period. A value; allocates nothing.
class CommandHistory {
 public:
  static constexpr std::size_t kMax = 64;  ///< 3.2 s at 50 ms

  void add(types::Stamp now, const types::Twist2& commanded) {
    newest_ = (newest_ + 1) % kMax;
    entries_[newest_] = {now, commanded};
    if (count_ < kMax) ++count_;
  }
  void clear() { count_ = 0; }

  /// The command in force at a time: standstill before the oldest.
  [[nodiscard]] types::Twist2 at(types::Stamp time) const {
    for (std::size_t i = 0; i < count_; ++i) {
      const Entry& entry = entries_[(newest_ + kMax - i) % kMax];
      if (entry.stamp <= time) return entry.twist;
    }
    return {};
  }

 private:
  struct Entry {
    types::Stamp stamp{};
    types::Twist2 twist;
  };
  std::array<Entry, kMax> entries_{};
  std::size_t newest_ = 0;
  std::size_t count_ = 0;
};

}  // namespace topo::plausibility
