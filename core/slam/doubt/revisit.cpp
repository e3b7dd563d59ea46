// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/slam/doubt/revisit.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <numeric>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/grid/occupancy_grid.hpp"
#include "core/slam/doubt/beam_fan.hpp"
#include "core/slam/doubt/visits.hpp"

namespace topo::slam {
namespace {

using types::Vector2;

/// A set of stretches for each occupied cell that a beam hit: what it takes grows with the walls of the map,
/// and not with its box.
class Marks {
 public:
  explicit Marks(std::size_t words) : words_(words) {}
  void set(grid::CellIndex cell, std::size_t stretch) {
    const auto [at, is_new] = places_.try_emplace(key(cell), bits_.size());
    if (is_new) bits_.resize(bits_.size() + words_, 0);
    bits_[at->second + stretch / 64] |= std::uint64_t{1} << (stretch % 64);
  }
  [[nodiscard]] bool any(grid::CellIndex cell, const std::uint64_t* of) const {
    const auto at = places_.find(key(cell));
    if (at == places_.end()) return false;
    for (std::size_t i = 0; i < words_; ++i) {
      if ((bits_[at->second + i] & of[i]) != 0) return true;
    }
    return false;
  }

 private:
  static std::uint64_t key(grid::CellIndex cell) {
    return std::uint64_t{static_cast<std::uint32_t>(cell.x)} << 32U | static_cast<std::uint32_t>(cell.y);
  }
  std::size_t words_;
  std::unordered_map<std::uint64_t, std::size_t> places_;
  std::vector<std::uint64_t> bits_;
};

/// A hit that no other visit's hit is near to: counts when another visit looked there. There may be one for
/// each beam of the map: kept small.
struct Open {
  Point position, normal;  ///< SurfacePoint in map
  std::uint32_t stretch = 0;
  [[nodiscard]] SurfacePoint surface() const { return {position.cast<double>(), normal.cast<double>()}; }
};

class Counter {
 public:
  Counter(std::span<const KeyframePtr> keyframes, std::span<const types::Se2> poses,
          const grid::OccupancyGrid& map, double tolerance_m)
      : keyframes_(keyframes),
        poses_(poses),
        map_(map),
        tolerance_m_(tolerance_m),
        visits_(poses),
        hit_(visits_.words()) {}

  RevisitShare run() {
    for (std::size_t i = 0; i < keyframes_.size(); ++i) mark(i);
    std::deque<Open> open;
    for (std::size_t i = 0; i < keyframes_.size(); ++i) compare(i, open);
    look_through(std::move(open));
    for (auto& [place, region] : regions_) {
      region.centre = RevisitRegion::kSide_m * (Vector2(place.second, place.first) + Vector2(0.5, 0.5));
      out_.regions.push_back(region);
    }
    return std::move(out_);
  }

 private:
  [[nodiscard]] bool is_occupied(grid::CellIndex cell) const {
    return map_.state(cell) == grid::CellState::kOccupied;
  }
  void mark(std::size_t i) {
    for (const Point& hit : keyframes_[i]->content.hits()) {
      const grid::CellIndex cell = map_.cell_at(poses_[i] * Vector2(hit.cast<double>()));
      if (is_occupied(cell)) hit_.set(cell, visits_.stretch_of(i));
    }
  }
  void compare(std::size_t i, std::deque<Open>& open) {
    const Keyframe& keyframe = *keyframes_[i];
    const std::vector<Surfel> surfels = keyframe.content.surfels();
    for (const Point& hit : keyframe.content.hits()) {
      const Vector2 p = poses_[i] * Vector2(hit.cast<double>());
      if (is_near_a_hit(p, visits_.stretch_of(i))) {
        count(p, true);
        continue;
      }
      const Vector2 normal =
          Eigen::Rotation2Dd(poses_[i].theta_rad) * surface_at(surfels, keyframe.sensor, hit).normal;
      open.push_back(
          {p.cast<float>(), normal.cast<float>(), static_cast<std::uint32_t>(visits_.stretch_of(i))});
    }
  }
  void count(const Vector2& p, bool within) {
    RevisitRegion& region = regions_[{static_cast<int>(std::floor(p.y() / RevisitRegion::kSide_m)),
                                      static_cast<int>(std::floor(p.x() / RevisitRegion::kSide_m))}];
    ++out_.points;
    ++region.points;
    out_.within += within ? 1U : 0U;
    region.within += within ? 1U : 0U;
  }
  /// Keyframe by keyframe, so that the beams of one are held at a time.
  void look_through(std::deque<Open> open) {
    for (std::size_t k = 0; k < keyframes_.size() && !open.empty(); ++k) {
      const BeamFan fan(*keyframes_[k], poses_[k]);
      std::erase_if(open, [&](const Open& point) {
        const bool contradicted = visits_.are_apart(point.stretch, visits_.stretch_of(k)) &&
                                  fan.contradicts(point.surface(), tolerance_m_);
        if (contradicted) count(point.position.cast<double>(), false);
        return contradicted;
      });
    }
  }

  /// Is there an occupied cell within the tolerance that another visit hit?
  [[nodiscard]] bool is_near_a_hit(const Vector2& p, std::size_t stretch) const {
    const int reach = static_cast<int>(std::ceil(tolerance_m_ / map_.resolution_m()));
    const grid::CellIndex centre = map_.cell_at(p);
    for (int y = -reach; y <= reach; ++y) {
      for (int x = -reach; x <= reach; ++x) {
        const grid::CellIndex cell{centre.x + x, centre.y + y};
        if ((map_.centre_of(cell) - p).norm() > tolerance_m_) continue;
        if (is_occupied(cell) && hit_.any(cell, visits_.others(stretch))) return true;
      }
    }
    return false;
  }

  std::span<const KeyframePtr> keyframes_;
  std::span<const types::Se2> poses_;
  const grid::OccupancyGrid& map_;
  double tolerance_m_;
  Visits visits_;
  Marks hit_;
  RevisitShare out_;
  std::map<std::pair<int, int>, RevisitRegion> regions_;  ///< by row and column
};

}  // namespace

RevisitShare revisit_share(std::span<const KeyframePtr> keyframes, std::span<const types::Se2> poses,
                           const grid::OccupancyGrid& map, double tolerance_m) {
  // Of a team the list has keyframes of all robots by turns; a way is that of one.
  std::vector<std::size_t> order(keyframes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return keyframes[i]->id.robot; });
  std::vector<KeyframePtr> by_robot;
  std::vector<types::Se2> poses_by_robot;
  for (const std::size_t i : order) {
    by_robot.push_back(keyframes[i]);
    poses_by_robot.push_back(poses[i]);
  }
  return Counter(by_robot, poses_by_robot, map, tolerance_m).run();
}

}  // namespace topo::slam
