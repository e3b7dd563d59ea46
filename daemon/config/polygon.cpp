// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/config/polygon.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace topo::daemon {
namespace {

using types::Vector2;

constexpr double kFarthest_m = 1e4;

double cross(const Vector2& a, const Vector2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Side of the line from a to b on which the point is: 1 left, -1 right, 0 on the line.
int side(const Vector2& a, const Vector2& b, const Vector2& p) {
  const double area = cross(b - a, p - a);
  return area > 0.0 ? 1 : area < 0.0 ? -1 : 0;
}

bool in_box(const Vector2& a, const Vector2& b, const Vector2& p) {
  return p.x() >= std::min(a.x(), b.x()) && p.x() <= std::max(a.x(), b.x()) &&
         p.y() >= std::min(a.y(), b.y()) && p.y() <= std::max(a.y(), b.y());
}

/// True when the segments a-b and c-d cross or touch.
bool meet(const Vector2& a, const Vector2& b, const Vector2& c, const Vector2& d) {
  const int abc = side(a, b, c), abd = side(a, b, d), cda = side(c, d, a), cdb = side(c, d, b);
  if (abc * abd < 0 && cda * cdb < 0) return true;
  return (abc == 0 && in_box(a, b, c)) || (abd == 0 && in_box(a, b, d)) || (cda == 0 && in_box(c, d, a)) ||
         (cdb == 0 && in_box(c, d, b));
}

/// True when the polygon folds back on itself at corner `i`.
bool folds(const types::Polygon& p, std::size_t i) {
  const std::size_t n = p.size();
  const Vector2 in = p[i] - p[(i + n - 1) % n], out = p[(i + 1) % n] - p[i];
  return cross(in, out) == 0.0 && in.dot(out) <= 0.0;
}

/// First corner of the later of two edges that cross or touch; nothing when none do.
std::optional<std::size_t> crossing(const types::Polygon& p) {
  const std::size_t n = p.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (folds(p, i)) return i;
    for (std::size_t j = 0; j + 1 < i; ++j) {
      const bool neighbours = j == 0 && i == n - 1;
      if (!neighbours && meet(p[i], p[(i + 1) % n], p[j], p[j + 1])) return i;
    }
  }
  return {};
}

std::string too_few(std::size_t corners) {
  return fmt::format("{} corners make no area, three are needed", corners);
}

std::string crosses(std::size_t at) {
  return fmt::format("the edge from corner {} crosses or touches another one", at + 1);
}

bool read_corner(const toml::node& node, Vector2& corner) {
  const auto* pair = node.as_array();
  if (pair == nullptr || pair->size() != 2) return false;
  for (std::size_t i = 0; i < 2; ++i) {
    const auto value = (*pair)[i].value<double>();
    if (!(*pair)[i].is_number() || !value || !(std::abs(*value) <= kFarthest_m)) return false;
    corner[static_cast<Eigen::Index>(i)] = *value;
  }
  return true;
}

}  // namespace

std::optional<PolygonFault> read_polygon(const toml::node& node, types::Polygon& polygon) {
  const auto* corners = node.as_array();
  if (corners == nullptr) return PolygonFault{"a polygon is a list of corners", &node};
  types::Polygon read;
  for (const auto& element : *corners) {
    Vector2 corner{0.0, 0.0};
    if (!read_corner(element, corner))
      return PolygonFault{
          fmt::format("corner {} is no pair of numbers up to {}", read.size() + 1, kFarthest_m), &element};
    read.push_back(corner);
  }
  if (read.size() < 3) return PolygonFault{too_few(read.size()), &node};
  if (const auto at = crossing(read)) return PolygonFault{crosses(*at), corners->get(*at)};
  polygon = std::move(read);
  return {};
}

types::Status check_polygon(const types::Polygon& polygon) {
  using types::Errc;
  using types::fail;
  const auto is_far = [](const Vector2& p) { return !(p.cwiseAbs().maxCoeff() <= kFarthest_m); };
  if (const auto far = std::ranges::find_if(polygon, is_far); far != polygon.end()) {
    return fail(Errc::kInvalidInput, fmt::format("corner {} is no pair of numbers up to {}",
                                                 far - polygon.begin() + 1, kFarthest_m));
  }
  if (polygon.size() < 3) return fail(Errc::kInvalidInput, too_few(polygon.size()));
  if (const auto at = crossing(polygon)) return fail(Errc::kInvalidInput, crosses(*at));
  return {};
}

std::string polygon_text(const types::Polygon& polygon) {
  std::string text;
  for (const Vector2& corner : polygon)
    text += fmt::format("{}[{:#}, {:#}]", text.empty() ? "" : ", ", corner.x(), corner.y());
  return "[" + text + "]";
}

}  // namespace topo::daemon
