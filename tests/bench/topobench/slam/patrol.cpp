// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/slam/patrol.hpp"

#include <algorithm>
#include <cmath>
#include <queue>

#include "tests/sim/area.hpp"
#include "tests/sim/random.hpp"

namespace topo::bench {
namespace {

using sim::Vector2;

constexpr double kCell_m = 0.1;         ///< of the planning grid
constexpr double kRoomy_m = 0.8;        ///< beyond, more room is worth nothing
constexpr double kVisited_m = 4.0;      ///< how near counts as visited
constexpr int kCandidates = 24;         ///< places drawn for each decision
constexpr std::size_t kStraight = 300;  ///< cells that one straight way may span
constexpr float kUnreached = 1e30F;

/// Cells with what a metre in them costs; 0: not to be entered.
class Ground {
 public:
  Ground(const sim::Raster& free, double clearance_min_m) {
    const std::vector<float> clearance = sim::clearance_m(free);
    const int factor = std::max(1, static_cast<int>(std::lround(kCell_m / free.resolution_m)));
    raster_ = {free.resolution_m * factor, free.origin, free.width / factor, free.height / factor};
    cost_.resize(raster_.cells.size());
    for (int y = 0; y < raster_.height; ++y) {
      for (int x = 0; x < raster_.width; ++x) {
        const Vector2 p = raster_.center(x, y);
        const double room = static_cast<double>(clearance[free.index(free.column(p.x()), free.row(p.y()))]);
        if (room < clearance_min_m) continue;
        const double tight = std::max(0.0, (kRoomy_m - room) / (kRoomy_m - clearance_min_m));
        cost_[raster_.index(x, y)] = static_cast<float>(1.0 + 3.0 * tight * tight);
      }
    }
  }

  [[nodiscard]] const sim::Raster& raster() const { return raster_; }
  [[nodiscard]] float cost(std::size_t i) const { return cost_[i]; }
  [[nodiscard]] float cost_at(const Vector2& p) const {
    const int x = raster_.column(p.x()), y = raster_.row(p.y());
    return raster_.inside(x, y) ? cost_[raster_.index(x, y)] : 0.0F;
  }

  /// Cost of the straight way; kUnreached when it is barred.
  [[nodiscard]] float cost_along(const Vector2& a, const Vector2& b) const {
    const double length = (b - a).norm(), step = 0.25 * raster_.resolution_m;
    const int steps = std::max(1, static_cast<int>(std::ceil(length / step)));
    float sum = 0.0F;
    for (int i = 0; i <= steps; ++i) {
      const float here = cost_at(a + (static_cast<double>(i) / steps) * (b - a));
      if (here == 0.0F) return kUnreached;
      sum += here;
    }
    return sum * static_cast<float>(length) / static_cast<float>(steps + 1);
  }

 private:
  sim::Raster raster_;
  std::vector<float> cost_;
};

/// Cheapest ways from one cell to all (Dijkstra 1959).
class Ways {
 public:
  Ways(const Ground& ground, const Vector2& from)
      : ground_(ground), cost_(ground.raster().cells.size(), kUnreached), before_(cost_.size(), -1) {
    const sim::Raster& raster = ground.raster();
    using Item = std::pair<float, int>;
    std::priority_queue<Item, std::vector<Item>, std::greater<>> queue;
    const int first = static_cast<int>(raster.index(raster.column(from.x()), raster.row(from.y())));
    cost_[static_cast<std::size_t>(first)] = 0.0F;
    for (queue.emplace(0.0F, first); !queue.empty();) {
      const auto [so_far, at] = queue.top();
      queue.pop();
      if (so_far > cost_[static_cast<std::size_t>(at)]) continue;
      expand(at, so_far, queue);
    }
  }

  [[nodiscard]] float cost(std::size_t cell) const { return cost_[cell]; }

  /// Way points without the first, straightened where that costs next to nothing.
  [[nodiscard]] std::vector<Vector2> to(std::size_t cell) const {
    std::vector<int> cells;
    for (int at = static_cast<int>(cell); at >= 0; at = before_[static_cast<std::size_t>(at)])
      cells.push_back(at);
    std::reverse(cells.begin(), cells.end());
    std::vector<Vector2> points;
    for (std::size_t i = 0; i + 1 < cells.size();) {
      std::size_t next = i + 1;
      for (std::size_t j = i + 2; j < std::min(cells.size(), i + kStraight); ++j) {
        const float along =
            cost_[static_cast<std::size_t>(cells[j])] - cost_[static_cast<std::size_t>(cells[i])];
        if (ground_.cost_along(centre(cells[i]), centre(cells[j])) <= 1.01F * along) next = j;
      }
      points.push_back(centre(cells[next]));
      i = next;
    }
    return points;
  }

 private:
  template <typename Queue>
  void expand(int at, float so_far, Queue& queue) {
    const sim::Raster& raster = ground_.raster();
    const int x = at % raster.width, y = at / raster.width;
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        if (!raster.inside(x + dx, y + dy) || (dx == 0 && dy == 0)) continue;
        const std::size_t next = raster.index(x + dx, y + dy);
        if (ground_.cost(next) == 0.0F) continue;
        const float step =
            static_cast<float>(raster.resolution_m) * (dx != 0 && dy != 0 ? 1.41421356F : 1.0F);
        const float total =
            so_far + step * 0.5F * (ground_.cost(next) + ground_.cost(static_cast<std::size_t>(at)));
        if (total >= cost_[next]) continue;
        cost_[next] = total;
        before_[next] = at;
        queue.emplace(total, static_cast<int>(next));
      }
    }
  }
  [[nodiscard]] Vector2 centre(int cell) const {
    return ground_.raster().center(cell % ground_.raster().width, cell / ground_.raster().width);
  }

  const Ground& ground_;
  std::vector<float> cost_;
  std::vector<int> before_;
};

/// How long ago the way passed near a place, in points back; a place never visited counts as oldest.
std::size_t age(const std::vector<Vector2>& passed, const Vector2& place) {
  for (std::size_t back = 0; back < passed.size(); ++back) {
    if ((passed[passed.size() - 1 - back] - place).norm() < kVisited_m) return back;
  }
  return passed.size();
}

/// Points along a straight piece of the way, for age().
void pass(std::vector<Vector2>& passed, const Vector2& from, const Vector2& to) {
  const int parts = std::max(1, static_cast<int>((to - from).norm() / (0.5 * kVisited_m)));
  for (int i = 1; i <= parts; ++i) passed.push_back(from + (static_cast<double>(i) / parts) * (to - from));
}

}  // namespace

std::vector<Vector2> patrol(const sim::Raster& free, const Vector2& start, double clearance_min_m,
                            double length_m, std::uint64_t seed) {
  const Ground ground(free, clearance_min_m);
  if (ground.cost_at(start) == 0.0F) return {};
  std::vector<std::size_t> reachable;
  {
    const Ways ways(ground, start);
    for (std::size_t i = 0; i < ground.raster().cells.size(); ++i) {
      if (ways.cost(i) < kUnreached) reachable.push_back(i);
    }
  }
  sim::Random random(seed);
  const auto width = static_cast<std::size_t>(ground.raster().width);
  const auto centre = [&](std::size_t cell) {
    return ground.raster().center(static_cast<int>(cell % width), static_cast<int>(cell / width));
  };
  std::vector<Vector2> way{start}, passed{start};
  double length = 0.0;
  for (int places = 0; length < length_m && places < 10000; ++places) {
    std::size_t best = reachable.front(), best_age = 0;
    for (int k = 0; k < kCandidates; ++k) {
      const std::size_t cell = reachable[static_cast<std::size_t>(random.next() % reachable.size())];
      const std::size_t old = age(passed, centre(cell));
      if (k == 0 || old > best_age) {
        best = cell;
        best_age = old;
      }
    }
    for (const Vector2& p : Ways(ground, way.back()).to(best)) {
      length += (p - way.back()).norm();
      pass(passed, way.back(), p);
      way.push_back(p);
    }
  }
  return way;
}

}  // namespace topo::bench
