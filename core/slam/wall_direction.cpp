// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/slam/wall_direction.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/types/se2.hpp"

namespace topo::slam {
namespace {

constexpr double kQuarter_rad = 0.5 * std::numbers::pi;
constexpr std::size_t kBins = 90;  // of one degree

std::size_t bin_of(double angle_rad) {
  const double turns = angle_rad / kQuarter_rad;
  return static_cast<std::size_t>((turns - std::floor(turns)) * kBins) % kBins;
}

/// Middle of the three neighbouring bins that hold most.
double fullest_rad(std::span<const double> angles_rad) {
  std::array<std::size_t, kBins> bins{};
  for (const double angle_rad : angles_rad) ++bins[bin_of(angle_rad)];
  std::size_t best = 0, most = 0;
  for (std::size_t i = 0; i < kBins; ++i) {
    const std::size_t three = bins[(i + kBins - 1) % kBins] + bins[i] + bins[(i + 1) % kBins];
    if (three > most) {
      most = three;
      best = i;
    }
  }
  return (static_cast<double>(best) + 0.5) * kQuarter_rad / kBins;
}

}  // namespace

CommonDirection common_direction(std::span<const double> angles_rad, double near_rad) {
  CommonDirection common{fullest_rad(angles_rad), 0};
  for (int pass = 0; pass < 3; ++pass) {  // the mean moves the window, which moves the mean
    double sum_rad = 0.0;
    common.near = 0;
    for (const double angle_rad : angles_rad) {
      const double off_rad = types::within_quarter(angle_rad - common.angle_rad);
      if (std::abs(off_rad) > near_rad) continue;
      sum_rad += off_rad;
      ++common.near;
    }
    if (common.near == 0) break;
    common.angle_rad += sum_rad / static_cast<double>(common.near);
  }
  return common;
}

std::optional<double> wall_direction(std::span<const Surfel> surfels, const WallDirectionParams& params) {
  std::vector<double> normals_rad;
  normals_rad.reserve(surfels.size());
  for (const Surfel& surfel : surfels) {
    if (surfel.planar)
      normals_rad.push_back(
          std::atan2(static_cast<double>(surfel.normal.y()), static_cast<double>(surfel.normal.x())));
  }
  const CommonDirection common = common_direction(normals_rad, params.near_rad);
  if (common.near < params.surfels_min ||
      static_cast<double>(common.near) < params.share_min * static_cast<double>(normals_rad.size()))
    return std::nullopt;
  return common.angle_rad;
}

}  // namespace topo::slam
