// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <toml++/toml.h>

#include <optional>
#include <string>

#include "core/types/area_limits.hpp"
#include "core/types/result.hpp"

namespace topo::daemon {

/// A fault of a polygon, and its position in the file.
struct PolygonFault {
  std::string what;
  const toml::node* where = nullptr;
};

/// Reads [[x, y], [x, y], ...]: at least three corners of two finite numbers each, at most 10 km in
/// magnitude, whose edges do not cross or touch except at common corners.
std::optional<PolygonFault> read_polygon(const toml::node& node, types::Polygon& polygon);

/// The same of corners that are read already. kInvalidInput says which corner and what is wrong.
types::Status check_polygon(const types::Polygon& polygon);

/// A polygon in the form that read_polygon() accepts.
std::string polygon_text(const types::Polygon& polygon);

}  // namespace topo::daemon
