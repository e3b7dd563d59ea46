// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "core/plausibility/params.hpp"
#include "core/types/scan.hpp"
#include "core/types/se2.hpp"

namespace topo::plausibility {

/// Shares of the beams within 90 degrees of the robot's heading; 0 when the scanner has none there.
struct ForwardShares {
  double empty = 0.0;    ///< without a return
  double failed = 0.0;   ///< with a fault in place of a range
  double covered = 0.0;  ///< nearer than PictureParams::covered_m, or below the scanner's least range
};
[[nodiscard]] ForwardShares forward_shares(const types::Scan& scan, const types::Se2& T_base_laser,
                                           double covered_m);

struct PictureOpinion {
  bool blind = false, failed = false, frozen = false, covered = false;
};

/// Judges the pictures of the front scanner one after another. Allocates nothing.
class PictureCheck {
 public:
  explicit PictureCheck(const PictureParams& params = {}) : params_(params) {}

  /// A new scan.
  PictureOpinion judge(const types::Scan& scan, const types::Se2& T_base_laser);

 private:
  /// How many pictures may have been equal up to this one. Of those that arrive within a control period only
  /// the newest is seen: the others count as equal to it.
  std::uint64_t equal_pictures(const types::Scan& scan);

  PictureParams params_;
  types::Stamp empty_since_{}, failed_since_{}, covered_since_{};  ///< zero: not now
  std::uint64_t first_equal_ = 0, newest_ = 0;                     ///< sequence numbers
  std::uint16_t beams_ = 0;
  std::array<float, types::Scan::kMaxBeams> last_{};
};

}  // namespace topo::plausibility
