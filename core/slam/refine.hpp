// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "core/slam/surfel_map.hpp"

namespace topo::slam {

/// Estimate before the scan is used: mean and information (inverse covariance) of T_map_base in map axes (x,
/// y, theta).
struct Prior {
  types::Se2 T_map_base;
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
};

/// A match with its evidence; the caller's gate accepts or rejects it.
struct Match {
  types::Se2 T_map_base;
  double response = 0.0;  ///< share of all points within `inlier_m` of a surface
  double overlap = 0.0;   ///< share of all points that have a surfel in reach
  double rms_m = 0.0;     ///< of the inliers
  Eigen::Matrix3d scan_information = Eigen::Matrix3d::Zero();  ///< of the scan alone, map axes
  bool degenerate = false;  ///< the scan does not determine one direction of translation
  int iterations = 0;

  /// Share of inliers among the points for which the map has a surfel.
  [[nodiscard]] double fit() const { return overlap > 0.0 ? response / overlap : 0.0; }
};

/// Gauss-Newton over point-to-line distances with a Cauchy kernel (Censi 2008 for the metric), from `start`,
/// with the prior as an additional measurement. Points are in base_link. Pure function; allocates nothing.
Match refine(const SurfelMap& map, std::span<const Point> points, const Point& sensor,
             const types::Se2& start, const std::optional<Prior>& prior, const RefineParams& params);

/// Evaluates the evidence at a pose without moving it.
Match evaluate(const SurfelMap& map, std::span<const Point> points, const Point& sensor,
               const types::Se2& pose, const RefineParams& params);

}  // namespace topo::slam
