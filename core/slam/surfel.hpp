// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace topo::slam {

using Point = Eigen::Vector2f;

/// A small piece of a surface: a measured point and the unit normal towards the sensor. Where `planar`, the
/// point is projected onto the line fitted to its neighbourhood. `planar` is false where the neighbourhood is
/// not a line (a chair leg); such a surfel constrains in both directions.
struct Surfel {
  Point position;
  Point normal;
  bool planar = false;
};

}  // namespace topo::slam
