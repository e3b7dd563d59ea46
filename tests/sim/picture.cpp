// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/sim/picture.hpp"

#include <png.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace topo::sim {

namespace {

constexpr int kSideMax_px = 4000;
constexpr Colour kLowInk{190, 140, 70};
constexpr Colour kHangingInk{170, 110, 200};
constexpr Colour kGlassInk{70, 190, 230};

}  // namespace

Picture::Picture(const types::Rectangle& area, double metres_per_pixel) : area_(area) {
  const Vector2 size = area.max - area.min;
  scale_m_ = std::max(metres_per_pixel, size.maxCoeff() / kSideMax_px);
  width_ = std::max(1, static_cast<int>(std::ceil(size.x() / scale_m_)));
  height_ = std::max(1, static_cast<int>(std::ceil(size.y() / scale_m_)));
  pixels_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_) * 3, 255);
}

int Picture::column(double x_m) const {
  return static_cast<int>(std::floor((x_m - area_.min.x()) / scale_m_));
}
int Picture::row(double y_m) const { return static_cast<int>(std::floor((area_.max.y() - y_m) / scale_m_)); }

void Picture::set(int x, int y, Colour colour) {
  if (x < 0 || y < 0 || x >= width_ || y >= height_) return;
  const std::size_t at =
      (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)) * 3;
  pixels_[at] = colour.red;
  pixels_[at + 1] = colour.green;
  pixels_[at + 2] = colour.blue;
}

Colour Picture::at(const Vector2& p) const {
  const int x = std::clamp(column(p.x()), 0, width_ - 1);
  const int y = std::clamp(row(p.y()), 0, height_ - 1);
  const std::size_t i =
      (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)) * 3;
  return {pixels_[i], pixels_[i + 1], pixels_[i + 2]};
}

void Picture::dot(const Vector2& p, Colour colour, int radius_px) {
  if (!p.allFinite()) return;
  const int x0 = column(p.x());
  const int y0 = row(p.y());
  for (int y = -radius_px; y <= radius_px; ++y) {
    for (int x = -radius_px; x <= radius_px; ++x) {
      if (x * x + y * y <= radius_px * radius_px) set(x0 + x, y0 + y, colour);
    }
  }
}

void Picture::line(const Vector2& a, const Vector2& b, Colour colour) {
  if (!a.allFinite() || !b.allFinite()) return;
  const int steps = std::clamp(static_cast<int>(std::ceil(2.0 * (b - a).norm() / scale_m_)), 1, 100'000);
  for (int i = 0; i <= steps; ++i) dot(a + (b - a) * (static_cast<double>(i) / steps), colour);
}

void Picture::fill(const Polygon& polygon, Colour colour) {
  const types::Rectangle box = bounds(polygon);
  for (int y = row(box.max.y()); y <= row(box.min.y()); ++y) {
    for (int x = column(box.min.x()); x <= column(box.max.x()); ++x) {
      const Vector2 p(area_.min.x() + (x + 0.5) * scale_m_, area_.max.y() - (y + 0.5) * scale_m_);
      if (contains(polygon, p)) set(x, y, colour);
    }
  }
}

void Picture::tint(const Raster& raster, Colour colour) {
  const auto mix = [](std::uint8_t a, std::uint8_t b) { return static_cast<std::uint8_t>((a + b) / 2); };
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x) {
      const Vector2 p(area_.min.x() + (x + 0.5) * scale_m_, area_.max.y() - (y + 0.5) * scale_m_);
      if (raster.at(p) == 0) continue;
      const Colour old = at(p);
      set(x, y, {mix(old.red, colour.red), mix(old.green, colour.green), mix(old.blue, colour.blue)});
    }
  }
}

void Picture::world(const World& world) {
  for (const Polygon& outline : world.wall_outlines()) {
    for (std::size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++)
      line(outline[j], outline[i], kWallInk);
  }
  // Low objects first, so that those that reach the ceiling stay visible.
  const double high_m = 0.9 * world.ceiling_m();
  for (const Prism& prism : world.prisms()) {
    if (prism.z_min_m == 0.0 && prism.z_max_m < high_m) fill(prism.outline, kLowInk);
  }
  for (const Prism& prism : world.prisms()) {
    if (prism.z_min_m > 0.0) fill(prism.outline, kHangingInk);
  }
  for (const Prism& prism : world.prisms()) {
    if (prism.z_min_m == 0.0 && prism.z_max_m >= high_m) fill(prism.outline, kWallInk);
  }
  for (const types::Segment& pane : world.glass()) line(pane.a, pane.b, kGlassInk);
}

void Picture::path(std::span<const Se2> poses, Colour colour) {
  for (std::size_t i = 1; i < poses.size(); ++i)
    line(poses[i - 1].translation(), poses[i].translation(), colour);
}

void Picture::sweep(const Sweep& sweep, const LaserModel& model, const LaserMount& mount, const Se2& pose,
                    Colour colour) {
  const Se2 sensor = pose * Se2{mount.x_m, mount.y_m, mount.yaw_rad};
  for (std::size_t i = 0; i < sweep.range_mm.size(); ++i) {
    const std::uint32_t mm = sweep.range_mm[i];
    if (mm < static_cast<std::uint32_t>(model.distance_min_mm) ||
        mm > static_cast<std::uint32_t>(model.distance_max_mm))
      continue;
    const double angle = model.angle_rad(sweep.step_min + static_cast<int>(i));
    const double range_m = 1e-3 * mm;
    const double forward = mount.plane == ScanPlane::kLevel ? std::cos(angle) : 0.0;
    dot(sensor * Vector2(range_m * forward, range_m * std::sin(angle)), colour, 1);
  }
}

types::Status Picture::save_png(const std::filesystem::path& file) const {
  png_image png;
  std::memset(&png, 0, sizeof png);
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(width_);
  png.height = static_cast<png_uint_32>(height_);
  png.format = PNG_FORMAT_RGB;
  if (png_image_write_to_file(&png, file.c_str(), 0, pixels_.data(), 0, nullptr) == 0) {
    return types::fail(types::Errc::kIo, file.string() + ": picture not written: " + png.message);
  }
  return {};
}

}  // namespace topo::sim
