// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/mapfile/overview.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>

namespace topo::daemon {
namespace {

using grid::CellState;

constexpr Rgb kUnknown{205, 205, 205}, kFree{254, 254, 254}, kOccupied{0, 0, 0};
constexpr Rgb kSkeleton{140, 140, 140}, kWall{220, 30, 30}, kPath{30, 60, 220};
constexpr Rgb kGoal{0, 130, 50}, kRejected{240, 140, 20}, kText{255, 255, 255}, kDoubted{230, 0, 120};

/// The digits, three by five pixels, three bits per row from the top.
constexpr std::array<unsigned, 10> kDigits = {075557, 026227, 071747, 071717, 055711,
                                              074717, 074757, 071244, 075757, 075717};

/// A hue for each place; consecutive numbers are far apart on the colour circle (golden ratio).
Rgb colour_of(std::uint16_t label) {
  const double hue = 6.0 * std::fmod(0.618034 * label, 1.0);
  const auto channel = [&](double shift) {
    const double x = std::fmod(hue + shift, 6.0);
    const double ramp = std::clamp(std::abs(x - 3.0) - 1.0, 0.0, 1.0);
    return static_cast<std::uint8_t>(std::lround(60.0 + 195.0 * ramp));
  };
  return {channel(0.0), channel(4.0), channel(2.0)};
}

Rgb mixed(Rgb a, Rgb b, double share_of_b) {
  const auto mix = [&](std::uint8_t u, std::uint8_t v) {
    return static_cast<std::uint8_t>(std::lround(u + share_of_b * (v - u)));
  };
  return {mix(a.r, b.r), mix(a.g, b.g), mix(a.b, b.b)};
}

/// The picture, and the mapping from cells to pixels.
class Sheet {
 public:
  explicit Sheet(const grid::DenseMap& map)
      : map_(map), box_(known_box(map)), scale_(scale_for(box_)), picture(make_picture()) {}

  [[nodiscard]] int scale() const { return scale_; }
  struct Pixel {
    int x, y;
  };
  /// Pixel of a point in map; clamped far outside, to bound the length of lines.
  [[nodiscard]] Pixel pixel(const types::Vector2& p) const {
    const auto at = [&](double v, double corner) {
      const double x = (v / map_.resolution_m - corner) * scale_;
      return static_cast<int>(std::clamp(std::isnan(x) ? 0.0 : std::floor(x), -1e5, 1e5));
    };
    return {at(p.x(), box_.min.x), picture.height() - 1 - at(p.y(), box_.min.y)};
  }
  void line(const types::Vector2& from, const types::Vector2& to, Rgb colour) {
    const Pixel a = pixel(from), b = pixel(to);
    picture.line(a.x, a.y, b.x, b.y, colour);
    // A second, parallel line gives sufficient thickness in every direction.
    if (scale_ > 1 && std::abs(b.x - a.x) > std::abs(b.y - a.y))
      picture.line(a.x, a.y + 1, b.x, b.y + 1, colour);
    else if (scale_ > 1)
      picture.line(a.x + 1, a.y, b.x + 1, b.y, colour);
  }
  /// f(index into the map) returns the colour of a cell, or nothing to leave it unchanged.
  template <class F>
  void paint_cells(F&& f) {
    for (int y = box_.min.y; y <= box_.max.y; ++y) {
      for (int x = box_.min.x; x <= box_.max.x; ++x) {
        const std::optional<Rgb> colour = f(map_.index({x, y}));
        if (!colour) continue;
        for (int v = 0; v < scale_; ++v) {
          for (int u = 0; u < scale_; ++u)
            picture.set((x - box_.min.x) * scale_ + u, picture.height() - 1 - (y - box_.min.y) * scale_ - v,
                        *colour);
        }
      }
    }
  }

 private:
  static grid::CellBox known_box(const grid::DenseMap& map) {
    constexpr int kMargin = 8;
    grid::CellBox box;
    for (std::size_t i = 0; i < map.cells.size(); ++i) {
      if (map.cells[i] != CellState::kUnknown) box.extend(map.cell(i));
    }
    if (box.empty()) return box;
    return {{std::max(box.min.x - kMargin, map.box.min.x), std::max(box.min.y - kMargin, map.box.min.y)},
            {std::min(box.max.x + kMargin, map.box.max.x), std::min(box.max.y + kMargin, map.box.max.y)}};
  }
  static int scale_for(const grid::CellBox& box) {
    const auto side = std::max(box.width(), box.height());
    return side <= 300 ? 3 : side <= 900 ? 2 : 1;
  }
  [[nodiscard]] Picture make_picture() const {
    if (box_.empty()) return {1, 1, kUnknown};
    return {static_cast<int>(box_.width()) * scale_, static_cast<int>(box_.height()) * scale_, kUnknown};
  }

  const grid::DenseMap& map_;
  grid::CellBox box_;
  int scale_;

 public:
  Picture picture;
};

void paint_map(const analysis::Analysis& analysis, Sheet& sheet) {
  const std::vector<std::uint16_t> labels = analysis.places.labels.by_cell(analysis.map.cells.size());
  const auto& on = analysis.skeleton.on;
  sheet.paint_cells([&](std::size_t i) -> std::optional<Rgb> {
    const CellState state = analysis.map.cells[i];
    if (state == CellState::kUnknown) return std::nullopt;
    if (state == CellState::kOccupied) return kOccupied;
    const Rgb place = labels[i] != 0 ? mixed(kFree, colour_of(labels[i]), 0.45) : kFree;
    return i < on.size() && on[i] ? mixed(place, kSkeleton, 0.6) : place;
  });
}

void draw_trajectory(std::span<const types::Se2> trajectory, Sheet& sheet) {
  if (trajectory.empty()) return;
  for (std::size_t k = 1; k < trajectory.size(); ++k)
    sheet.line(trajectory[k - 1].translation(), trajectory[k].translation(), kPath);
  const auto first = sheet.pixel(trajectory.front().translation()),
             last = sheet.pixel(trajectory.back().translation());
  sheet.picture.disc(first.x, first.y, 5, kPath);
  sheet.picture.disc(first.x, first.y, 3, kText);
  sheet.picture.disc(last.x, last.y, 4, kPath);
}

/// Draws the number centred at (x, y).
void draw_number(Picture& picture, int x, int y, std::size_t number, int scale) {
  const std::string text = std::to_string(number);
  int left = x - (static_cast<int>(text.size()) * 4 - 1) * scale / 2;
  for (const char c : text) {
    const unsigned digit = kDigits[static_cast<std::size_t>(c - '0')];
    for (int bit = 0; bit < 15; ++bit) {
      if ((digit >> (14 - bit) & 1U) == 0) continue;
      for (int v = 0; v < scale; ++v) {
        for (int u = 0; u < scale; ++u)
          picture.set(left + bit % 3 * scale + u, y - 5 * scale / 2 + bit / 3 * scale + v, kText);
      }
    }
    left += 4 * scale;
  }
}

void draw_goals(const analysis::Analysis& analysis, std::span<const goals::Goal> open_goals, Sheet& sheet) {
  for (const goals::Goal& goal : analysis.goals.rejected) {
    const auto [x, y] = sheet.pixel(goal.p_map);
    for (int v = -1; v <= 1; ++v) sheet.picture.line(x - 1, y + v, x + 1, y + v, kRejected);
  }
  const int size = std::max(sheet.scale(), 2);
  for (std::size_t k = 0; k < open_goals.size(); ++k) {
    sheet.line(open_goals[k].p_map, open_goals[k].opening, kGoal);
    const auto [x, y] = sheet.pixel(open_goals[k].p_map);
    sheet.picture.disc(x, y, 5 * size, kGoal);
    draw_number(sheet.picture, x, y, k + 1, size / 2 + (size > 2 ? 1 : 0));
  }
}

void frame(const slam::RevisitRegion& region, Sheet& sheet) {
  constexpr double kHalf_m = 0.5 * slam::RevisitRegion::kSide_m;
  const auto corner = [&](int i) -> types::Vector2 {
    return region.centre + kHalf_m * types::Vector2(i == 0 || i == 3 ? -1.0 : 1.0, i < 2 ? -1.0 : 1.0);
  };
  for (int i = 0; i < 4; ++i) sheet.line(corner(i), corner((i + 1) % 4), kDoubted);
}

}  // namespace

Picture overview_of(const analysis::Analysis& analysis, std::span<const types::Se2> trajectory,
                    std::span<const goals::Goal> open_goals, std::span<const slam::RevisitRegion> doubted) {
  Sheet sheet(analysis.map);
  paint_map(analysis, sheet);
  for (const types::Segment& wall : analysis.walls) sheet.line(wall.a, wall.b, kWall);
  for (const slam::RevisitRegion& region : doubted) frame(region, sheet);
  draw_trajectory(trajectory, sheet);
  draw_goals(analysis, open_goals, sheet);
  return std::move(sheet.picture);
}

}  // namespace topo::daemon
