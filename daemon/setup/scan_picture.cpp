// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/setup/scan_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace topo::daemon {

std::vector<std::string> scan_picture(const types::Scan& scan, const ScanPictureParams& params) {
  std::vector<std::string> lines(params.rows, std::string(params.columns, ' '));
  const double row_m = 2.0 * params.reach_m / static_cast<double>(params.rows);
  const double column_m = 2.0 * params.reach_m / static_cast<double>(params.columns);
  const auto draw = [&](double ahead_m, double left_m, char mark) {
    const double row = std::floor((params.reach_m - ahead_m) / row_m);
    const double column = std::floor((params.reach_m - left_m) / column_m);
    if (!(row >= 0.0 && row < static_cast<double>(params.rows))) return;
    if (!(column >= 0.0 && column < static_cast<double>(params.columns))) return;
    lines[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] = mark;
  };
  for (std::size_t i = 0; i < scan.checked_beams(); ++i) {
    if (!types::is_hit(scan.range_m[i])) continue;
    const auto r = static_cast<double>(scan.range_m[i]), angle = static_cast<double>(scan.angle_rad(i));
    draw(r * std::cos(angle), r * std::sin(angle), '#');
  }
  draw(0.0, 0.0, '+');
  return lines;
}

std::string side_by_side(std::span<const std::string> titles,
                         std::span<const std::vector<std::string>> pictures) {
  std::string out;
  std::size_t rows = 0;
  std::vector<std::size_t> widths;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    rows = std::max(rows, pictures[i].size());
    std::size_t width = i < titles.size() ? titles[i].size() : 0;
    for (const std::string& line : pictures[i]) width = std::max(width, line.size());
    widths.push_back(width);
  }
  const auto add_line = [&](auto text_of) {
    std::string line;
    for (std::size_t i = 0; i < pictures.size(); ++i)
      fmt::format_to(std::back_inserter(line), "{:<{}}  ", text_of(i), widths[i]);
    out.append(line.substr(0, line.find_last_not_of(' ') + 1)).append("\n");
  };
  add_line([&](std::size_t i) { return i < titles.size() ? titles[i] : std::string(); });
  for (std::size_t row = 0; row < rows; ++row)
    add_line([&](std::size_t i) { return row < pictures[i].size() ? pictures[i][row] : std::string(); });
  return out;
}

}  // namespace topo::daemon
