// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <toml++/toml.h>

#include <optional>
#include <string>

#include "core/types/area_limits.hpp"

namespace topo::daemon {

/// What is wrong with a polygon, and where in the file.
struct PolygonFault {
  std::string what;
  const toml::node* where = nullptr;
};

/// [[x, y], [x, y], ...]: at least three corners of two finite numbers each, no further than 10 km, whose
/// edges do not cross or touch but at common corners.
std::optional<PolygonFault> read_polygon(const toml::node& node, types::Polygon& polygon);

/// As read_polygon wants it.
std::string polygon_text(const types::Polygon& polygon);

}  // namespace topo::daemon
