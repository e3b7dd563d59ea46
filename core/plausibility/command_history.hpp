// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include "core/plausibility/params.hpp"
#include "core/types/robot_limits.hpp"
#include "core/types/stamp.hpp"
#include "core/types/transform.hpp"

namespace topo::plausibility {

/// Commands of the last seconds, one a control period, and the speeds of a base that follows them at once
/// with the believed accelerations. A value; allocates nothing.
class CommandHistory {
 public:
  static constexpr std::size_t kMax = 64;  ///< size of an array: 3.2 s at 50 ms

  explicit CommandHistory(const CommandHistoryParams& params = {}) : params_(params) {}

  void add(types::Stamp now, const types::Twist2& commanded, const types::DriveLimits& limits);

  /// The command in force at a time: standstill before the oldest.
  [[nodiscard]] types::Twist2 at(types::Stamp time) const;
  /// The speed that a prompt base had at a time.
  [[nodiscard]] types::Twist2 followed_at(types::Stamp time) const;

 private:
  struct Entry {
    types::Stamp stamp{};
    types::Twist2 commanded, followed;
  };
  [[nodiscard]] const Entry* find(types::Stamp time) const;
  CommandHistoryParams params_;
  std::array<Entry, kMax> entries_{};
  std::size_t newest_ = 0;
  std::size_t count_ = 0;
};

}  // namespace topo::plausibility
