// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/mapfile/picture.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace topo::daemon {

static_assert(sizeof(Rgb) == 3, "libpng reads the pixels as they lie");

Picture::Picture(int width, int height, Rgb fill)
    : width_(width),
      height_(height),
      pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), fill) {}

void Picture::set(int x, int y, Rgb colour) {
  if (x >= 0 && y >= 0 && x < width_ && y < height_) pixels_[index(x, y)] = colour;
}

void Picture::line(int x0, int y0, int x1, int y1, Rgb colour) {
  // Bresenham's algorithm, for all octants.
  const int dx = std::abs(x1 - x0), dy = -std::abs(y1 - y0);
  const int step_x = x0 < x1 ? 1 : -1, step_y = y0 < y1 ? 1 : -1;
  for (int error = dx + dy;;) {
    set(x0, y0, colour);
    if (x0 == x1 && y0 == y1) return;
    const int twice = 2 * error;
    if (twice >= dy) {
      error += dy;
      x0 += step_x;
    }
    if (twice <= dx) {
      error += dx;
      y0 += step_y;
    }
  }
}

void Picture::disc(int x, int y, int radius, Rgb colour) {
  for (int v = -radius; v <= radius; ++v) {
    for (int u = -radius; u <= radius; ++u) {
      if (u * u + v * v <= radius * radius) set(x + u, y + v, colour);
    }
  }
}

Picture picture_of(const MapImage& map) {
  Picture picture(map.width, map.height, {205, 205, 205});
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const MapCell cell = map.at(x, y);
      if (cell == MapCell::kFree) picture.set(x, map.height - 1 - y, {254, 254, 254});
      if (cell == MapCell::kOccupied) picture.set(x, map.height - 1 - y, {0, 0, 0});
    }
  }
  return picture;
}

void draw_path(Picture& picture, const MapImage& map, std::span<const types::Se2> path, Rgb colour) {
  if (path.empty()) return;
  const types::Se2 to_image = map.origin.inverse();
  struct Pixel {
    int x, y;
  };
  const auto pixel = [&](const types::Se2& pose) {
    const types::Vector2 p = to_image * pose.translation() / map.resolution_m;
    // Clamped, so that a pose far outside causes neither an endless line nor an overflow.
    const auto cell = [](double v) {
      return static_cast<int>(std::clamp(std::isnan(v) ? 0.0 : std::floor(v), -1e5, 1e5));
    };
    return Pixel{cell(p.x()), map.height - 1 - cell(p.y())};
  };
  Pixel last = pixel(path.front());
  picture.disc(last.x, last.y, 3, colour);
  for (const types::Se2& pose : path.subspan(1)) {
    const Pixel next = pixel(pose);
    picture.line(last.x, last.y, next.x, next.y, colour);
    last = next;
  }
  picture.disc(last.x, last.y, 3, colour);
}

}  // namespace topo::daemon
