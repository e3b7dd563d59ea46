// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/plausibility/picture_check.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

namespace topo::plausibility {
namespace {

/// Since when a condition has held without a break.
types::Stamp since(types::Stamp before, bool now, types::Stamp stamp) {
  if (!now) return {};
  return before == types::Stamp{} ? stamp : before;
}

bool lasts(types::Stamp begun, types::Stamp now, types::Duration at_least) {
  return begun != types::Stamp{} && now - begun >= at_least;
}

/// A range that was measured has noise.
bool has_a_range(const types::Scan& scan, double covered_m) {
  const auto ranges = scan.ranges();
  return std::any_of(ranges.begin(), ranges.end(), [covered_m](float range_m) {
    return std::isfinite(range_m) && range_m >= static_cast<float>(covered_m);
  });
}

/// Which of the three a picture without any range is.
PictureOpinion without_ranges(const ForwardShares& shares, bool open_space) {
  PictureOpinion opinion;
  opinion.failed = shares.failed > 0.0 && shares.failed >= std::max(shares.empty, shares.covered);
  opinion.covered = !opinion.failed && shares.covered > 0.0 && shares.covered >= shares.empty;
  opinion.blind = !opinion.failed && !opinion.covered && !open_space;
  return opinion;
}

}  // namespace

ForwardShares forward_shares(const types::Scan& scan, const types::Se2& T_base_laser, double covered_m) {
  std::size_t forward = 0, empty = 0, failed = 0, covered = 0;
  const auto ranges = scan.ranges();
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const double angle_rad =
        types::wrap_angle(T_base_laser.theta_rad + static_cast<double>(scan.angle_rad(i)));
    if (!(std::abs(angle_rad) <= std::numbers::pi / 2.0)) continue;
    ++forward;
    if (ranges[i] == types::kNoReturn) ++empty;
    if (std::isnan(ranges[i])) ++failed;
    if (ranges[i] < static_cast<float>(covered_m)) ++covered;  // kTooNear is -infinity
  }
  if (forward == 0) return {};
  // Failed and masked beams say nothing: counted among those that see something, they would hide a scanner
  // that sees nothing.
  const auto all = static_cast<double>(forward), told = static_cast<double>(forward - failed);
  return {told > 0.0 ? static_cast<double>(empty) / told : 0.0, static_cast<double>(failed) / all,
          static_cast<double>(covered) / all};
}

std::uint64_t PictureCheck::equal_pictures(const types::Scan& scan) {
  const auto ranges = scan.ranges();
  const bool same =
      scan.beams == beams_ && std::memcmp(ranges.data(), last_.data(), ranges.size_bytes()) == 0;
  const bool begins = beams_ == 0 || scan.sequence <= newest_;  // the first, or of a scanner started anew
  if (begins)
    first_equal_ = scan.sequence;
  else if (!same)
    first_equal_ = newest_ + 1;
  newest_ = scan.sequence;
  beams_ = scan.beams;
  std::copy(ranges.begin(), ranges.end(), last_.begin());
  return same ? scan.sequence - first_equal_ + 1 : 1;
}

PictureOpinion PictureCheck::judge(const types::Scan& scan, const types::Se2& T_base_laser) {
  const ForwardShares shares = forward_shares(scan, T_base_laser, params_.covered_m);
  empty_since_ = since(empty_since_, shares.empty > params_.blind_share, scan.arrival);
  failed_since_ = since(failed_since_, shares.failed > params_.blind_share, scan.arrival);
  covered_since_ = since(covered_since_, shares.covered >= params_.covered_share, scan.arrival);
  const bool repeats = equal_pictures(scan) >= params_.frozen_pictures && !params_.noiseless;
  const bool measured = has_a_range(scan, params_.covered_m);
  PictureOpinion opinion =
      repeats && !measured ? without_ranges(shares, params_.open_space) : PictureOpinion{};
  opinion.frozen = repeats && measured;
  opinion.blind |= !params_.open_space && lasts(empty_since_, scan.arrival, params_.blind_for);
  opinion.failed |= lasts(failed_since_, scan.arrival, params_.blind_for);
  opinion.covered |= lasts(covered_since_, scan.arrival, params_.covered_for);
  return opinion;
}

}  // namespace topo::plausibility
