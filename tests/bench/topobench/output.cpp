// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/bench/topobench/output.hpp"

#include <fmt/format.h>
#include <fstream>

namespace topo::bench {
types::Status write_map_files(const std::filesystem::path& folder, const pipeline::MapSnapshot& map,
                              const LogRun& run) {
  std::filesystem::create_directories(folder);
  std::ofstream f(folder / "trajectory.txt");
  for (const auto& p : run.trajectory)
    f << fmt::format("{:.6f} {:.6f} {:.6f} {:.6f}\n", p.stamp_s, p.pose.x_m, p.pose.y_m, p.pose.theta_rad);
  const auto box = map.grid.known_box();
  std::ofstream g(folder / "map.pgm", std::ios::binary);
  g << "P5\n" << box.width() << " " << box.height() << "\n255\n";
  for (int y = box.max.y; y >= box.min.y; --y)
    for (int x = box.min.x; x <= box.max.x; ++x) {
      auto s = map.grid.state({x, y});
      g.put(s == grid::CellState::kUnknown ? char(205) : s == grid::CellState::kFree ? char(254) : char(0));
    }
  return {};
}
}  // namespace topo::bench
