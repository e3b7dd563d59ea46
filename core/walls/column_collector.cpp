// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/walls/column_collector.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace topo::walls {

void ColumnCollector::add(const types::Scan& scan, const types::Se2& T_odom_first,
                          const types::Se2& T_odom_last) {
  const types::Se2 moved = last_used_.inverse() * T_odom_last;
  if (used_ && std::hypot(moved.x_m, moved.y_m) < params_.step_m &&
      std::abs(moved.theta_rad) < params_.step_rad)
    return;
  used_ = true;
  last_used_ = T_odom_last;
  const double side = mount_.mirrored ? -1.0 : 1.0;
  const double last_beam = std::max(1.0, scan.beams - 1.0);
  for (std::size_t i = 0; i < scan.beams; ++i) {
    const double r = static_cast<double>(scan.range_m[i]);
    if (!types::is_hit(scan.range_m[i]) || r > mount_.range_max_m) continue;
    const double angle = static_cast<double>(scan.angle_rad(i)) + mount_.roll_rad;
    const double height = mount_.z_m + r * std::cos(angle);
    if (height < mount_.height_min_m || height > mount_.height_max_m) continue;
    const types::Se2 base = types::interpolate(T_odom_first, T_odom_last, static_cast<double>(i) / last_beam);
    const types::Vector2 p = base * types::Vector2(mount_.x_m, mount_.y_m + side * r * std::sin(angle));
    columns_odom_.push_back({static_cast<float>(p.x()), static_cast<float>(p.y()), slab_of(height)});
  }
}

std::vector<ColumnPoint> ColumnCollector::take(const types::Se2& T_base_odom) {
  const float cell_m = params_.cell_m;
  const auto cell = [&](float v) { return static_cast<std::int32_t>(std::floor(v / cell_m)); };
  const auto key = [&](const ColumnPoint& c) { return std::make_tuple(cell(c.y_m), cell(c.x_m)); };
  std::stable_sort(columns_odom_.begin(), columns_odom_.end(),
                   [&](const ColumnPoint& a, const ColumnPoint& b) { return key(a) < key(b); });
  std::vector<ColumnPoint> columns;
  for (std::size_t i = 0; i < columns_odom_.size(); ++i) {
    if (i > 0 && key(columns_odom_[i]) == key(columns_odom_[i - 1])) {
      columns.back().slabs |= columns_odom_[i].slabs;
    } else {
      columns.push_back(columns_odom_[i]);
    }
  }
  columns_odom_.clear();
  for (ColumnPoint& column : columns) {
    const types::Vector2 p =
        T_base_odom * types::Vector2(static_cast<double>(column.x_m), static_cast<double>(column.y_m));
    column.x_m = static_cast<float>(p.x());
    column.y_m = static_cast<float>(p.y());
  }
  return columns;
}

}  // namespace topo::walls
