// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/sim/contours.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace topo::sim {

namespace {

enum Direction : int { kEast = 0, kNorth = 1, kWest = 2, kSouth = 3 };

struct Corner {
  int x, y;
};

constexpr std::array<Corner, 4> kStep{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};

bool is_solid(const Raster& solid, int x, int y) {
  return !solid.inside(x, y) || solid.cells[solid.index(x, y)] != 0;
}

// Cell to the left or right of the cell side that leaves corner c in a direction.
Corner left_of(const Corner& c, int direction) {
  constexpr std::array<Corner, 4> kLeft{{{0, 0}, {-1, 0}, {-1, -1}, {0, -1}}};
  const Corner& d = kLeft[static_cast<std::size_t>(direction)];
  return {c.x + d.x, c.y + d.y};
}
Corner right_of(const Corner& c, int direction) { return left_of(c, (direction + 3) % 4); }

// Follows the sides of cells with the solid on the left. Turns right where two solid cells meet only at their
// corners: they are one piece.
Polygon follow(const Raster& solid, Corner at, int direction, std::vector<std::uint8_t>& visited,
               int stride) {
  Polygon outline;
  const Corner first = at;
  const int first_direction = direction;
  do {
    if (direction == kEast) visited[static_cast<std::size_t>(at.y * stride + at.x)] = 1;
    const Corner& step = kStep[static_cast<std::size_t>(direction)];
    outline.emplace_back(solid.origin.x() + (at.x + 0.5 * step.x) * solid.resolution_m,
                         solid.origin.y() + (at.y + 0.5 * step.y) * solid.resolution_m);
    at = {at.x + step.x, at.y + step.y};
    const Corner left = left_of(at, direction);
    const Corner right = right_of(at, direction);
    if (is_solid(solid, right.x, right.y)) {
      direction = (direction + 3) % 4;
    } else if (!is_solid(solid, left.x, left.y)) {
      direction = (direction + 1) % 4;
    }
  } while (at.x != first.x || at.y != first.y || direction != first_direction);
  return outline;
}

double distance_to_line(const Vector2& p, const Vector2& a, const Vector2& b) {
  const Vector2 e = b - a;
  const double length = e.norm();
  if (length < 1e-12) return (p - a).norm();
  return std::abs(e.x() * (p.y() - a.y()) - e.y() * (p.x() - a.x())) / length;
}

void keep_between(const Polygon& outline, std::size_t first, std::size_t last, double tolerance_m,
                  std::vector<bool>& keep) {
  std::vector<std::pair<std::size_t, std::size_t>> todo{{first, last}};
  while (!todo.empty()) {
    const auto [from, to] = todo.back();
    todo.pop_back();
    std::size_t farthest = from;
    double distance = tolerance_m;
    for (std::size_t i = from + 1; i < to; ++i) {
      const double d = distance_to_line(outline[i], outline[from], outline[to % outline.size()]);
      if (d > distance) {
        distance = d;
        farthest = i;
      }
    }
    if (farthest == from) continue;
    keep[farthest] = true;
    todo.emplace_back(from, farthest);
    todo.emplace_back(farthest, to);
  }
}

// Douglas and Peucker 1973 on a closed line: indices of the points that stay.
std::vector<std::size_t> break_points(const Polygon& outline, double tolerance_m) {
  // Two distant points divide the ring.
  std::size_t opposite = 0;
  for (std::size_t i = 1; i < outline.size(); ++i) {
    if ((outline[i] - outline[0]).squaredNorm() > (outline[opposite] - outline[0]).squaredNorm())
      opposite = i;
  }
  std::vector<bool> keep(outline.size(), false);
  keep[0] = keep[opposite] = true;
  keep_between(outline, 0, opposite, tolerance_m, keep);
  keep_between(outline, opposite, outline.size(), tolerance_m, keep);
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    if (keep[i]) kept.push_back(i);
  }
  return kept;
}

struct FittedLine {
  Vector2 point, direction;
};

// Least squares fit through the points between two break points, without those next to the corners, which are
// cut there.
FittedLine fit_line(const Polygon& outline, std::size_t from, std::size_t to) {
  const std::size_t trim = to - from >= 8 ? 2 : 0;
  Vector2 mean(0.0, 0.0);
  double count = 0.0;
  for (std::size_t i = from + trim; i <= to - trim; ++i) {
    mean += outline[i % outline.size()];
    count += 1.0;
  }
  mean /= count;
  double xx = 0.0, xy = 0.0, yy = 0.0;
  for (std::size_t i = from + trim; i <= to - trim; ++i) {
    const Vector2 d = outline[i % outline.size()] - mean;
    xx += d.x() * d.x();
    xy += d.x() * d.y();
    yy += d.y() * d.y();
  }
  const double angle = 0.5 * std::atan2(2.0 * xy, xx - yy);
  return {mean, {std::cos(angle), std::sin(angle)}};
}

// Intersection of two neighbouring lines if it is near the break point between them; else the mean of the
// point's projections onto both.
Vector2 corner(const FittedLine& a, const FittedLine& b, const Vector2& at, double tolerance_m) {
  const double turn = a.direction.x() * b.direction.y() - a.direction.y() * b.direction.x();
  if (std::abs(turn) > 0.2) {
    const Vector2 r = b.point - a.point;
    const Vector2 meet = a.point + a.direction * ((r.x() * b.direction.y() - r.y() * b.direction.x()) / turn);
    if ((meet - at).norm() < 1.5 * tolerance_m) return meet;
  }
  const auto onto = [&at](const FittedLine& l) {
    return Vector2(l.point + l.direction * l.direction.dot(at - l.point));
  };
  return 0.5 * (onto(a) + onto(b));
}

void flood(const Raster& solid, int x0, int y0, std::uint32_t label, Pieces& pieces) {
  std::vector<Corner> todo{{x0, y0}};
  pieces.label[solid.index(x0, y0)] = label;
  while (!todo.empty()) {
    const Corner c = todo.back();
    todo.pop_back();
    const Vector2 low = solid.origin + solid.resolution_m * Vector2(c.x, c.y);
    pieces.box[label].extend(low);
    pieces.box[label].extend(low + Vector2(solid.resolution_m, solid.resolution_m));
    if (c.x == 0 || c.y == 0 || c.x == solid.width - 1 || c.y == solid.height - 1)
      pieces.at_border[label] = true;
    for (int y = c.y - 1; y <= c.y + 1; ++y) {
      for (int x = c.x - 1; x <= c.x + 1; ++x) {
        if (solid.at(x, y) == 0 || pieces.label[solid.index(x, y)] != 0) continue;
        pieces.label[solid.index(x, y)] = label;
        todo.push_back({x, y});
      }
    }
  }
}

}  // namespace

Pieces label_pieces(const Raster& solid) {
  Pieces pieces;
  pieces.label.assign(solid.cells.size(), 0);
  pieces.box.emplace_back();
  pieces.at_border.push_back(true);
  for (int y = 0; y < solid.height; ++y) {
    for (int x = 0; x < solid.width; ++x) {
      if (solid.at(x, y) == 0 || pieces.label[solid.index(x, y)] != 0) continue;
      pieces.box.emplace_back();
      pieces.at_border.push_back(false);
      flood(solid, x, y, static_cast<std::uint32_t>(pieces.box.size() - 1), pieces);
    }
  }
  return pieces;
}

Polygon straighten(const Polygon& outline, double tolerance_m) {
  if (outline.size() < 8) return outline;
  const std::vector<std::size_t> kept = break_points(outline, tolerance_m);
  if (kept.size() < 3) return outline;
  std::vector<FittedLine> lines;
  for (std::size_t k = 0; k < kept.size(); ++k) {
    const std::size_t to = k + 1 < kept.size() ? kept[k + 1] : kept[0] + outline.size();
    lines.push_back(fit_line(outline, kept[k], to));
  }
  Polygon out;
  for (std::size_t k = 0; k < kept.size(); ++k) {
    out.push_back(
        corner(lines[(k + kept.size() - 1) % kept.size()], lines[k], outline[kept[k]], tolerance_m));
  }
  const double before = std::abs(area_m2(outline));
  const bool spoiled = std::abs(std::abs(area_m2(out)) - before) > 0.25 * before;
  return spoiled ? outline : out;
}

std::vector<Contour> trace_contours(const Raster& solid, const Pieces& pieces, double tolerance_cells) {
  std::vector<Contour> contours;
  const int stride = solid.width + 1;
  std::vector<std::uint8_t> visited(
      static_cast<std::size_t>(stride) * static_cast<std::size_t>(solid.height + 1), 0);
  for (int y = 0; y <= solid.height; ++y) {
    for (int x = 0; x < solid.width; ++x) {
      if (visited[static_cast<std::size_t>(y * stride + x)] != 0) continue;
      if (!is_solid(solid, x, y) || is_solid(solid, x, y - 1)) continue;
      const Polygon outline = follow(solid, {x, y}, kEast, visited, stride);
      const std::uint32_t piece = solid.inside(x, y) ? pieces.label[solid.index(x, y)] : 0U;
      contours.push_back({straighten(outline, tolerance_cells * solid.resolution_m), piece});
    }
  }
  return contours;
}

}  // namespace topo::sim
