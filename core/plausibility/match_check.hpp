// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/plausibility/params.hpp"
#include "core/types/se2.hpp"
#include "core/types/stamp.hpp"

namespace topo::plausibility {

/// Motion since the start by scan matching and by odometry, at the stamp of one scan. The matched pose is the
/// product of the motions between consecutive scans: corrections of the map do not enter it.
struct MatchedMotion {
  types::Stamp stamp{};
  types::Se2 T_start_matched;
  types::Se2 T_start_odom;
  bool matched = false;  ///< false: no scan matched since the one before, the motion is the odometry's
};

/// The motion after one more scan: `T_previous_now` since the scan before, by matching.
[[nodiscard]] MatchedMotion after_scan(const MatchedMotion& before, types::Stamp stamp,
                                       const types::Se2& T_previous_now, const types::Se2& T_odom_base,
                                       bool matched);

/// Compares both over windows of matched scans.
class MatchCheck {
 public:
  explicit MatchCheck(const MatchParams& params = {}) : params_(params) {}

  /// A new scan was placed. True when the motions disagree.
  bool judge(const MatchedMotion& motion);
  [[nodiscard]] bool disagrees() const { return windows_ >= params_.windows; }

 private:
  MatchParams params_;
  MatchedMotion begin_;  ///< of the present window; the zero stamp: none
  int windows_ = 0;      ///< that disagreed, in a row
};

/// True when the two motions of a window differ by more than two good measurements can.
[[nodiscard]] bool disagree(const types::Se2& matched, const types::Se2& odom, const MatchParams& params);

}  // namespace topo::plausibility
