// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/types/geometry.hpp"
#include "core/types/result.hpp"
#include "tests/sim/raster.hpp"
#include "tests/sim/shapes.hpp"

namespace topo::sim {

/// Half-line with a direction of length 1, in the building's frame, metres.
struct Ray {
  double x, y, z;
  double dx, dy, dz;
};

enum class Surface : std::uint8_t { kNone, kWall, kGlass, kFloor, kCeiling, kMovable };

struct RayHit {
  double range_m;        ///< infinity when there is no hit within the limit
  double cos_incidence;  ///< 1: perpendicular
  Surface surface;
};

using MovableId = int;
inline constexpr MovableId kNoMovable = -1;

struct RayOptions {
  double range_max_m = 65.0;
  double glass_draw = 1.0;         ///< the ray passes glass with a larger transmission; 1: glass is a wall
  MovableId exclude = kNoMovable;  ///< the observer's own body
};

/// Contact point of a footprint, in the footprint's own frame.
struct Touch {
  bool touching = false;
  Vector2 point{0.0, 0.0};
};

struct StaticWorld;  // Geometry and its index; immutable and shared by copies.

/// The building, its ceiling, and movables. The building never changes after loading; movables (robots,
/// people, new boxes) are added and removed. Not thread-safe while movables change; otherwise const calls
/// are.
class World {
 public:
  /// From a map_server YAML with its image (pieces of occupied pixels under 1 m across are 0.8 m high, all
  /// else 2.5 m; unknown is solid; optional key `start: [x, y, theta]`), or from a drawn scene (.toml;
  /// config/worlds/office.toml documents every key). Errors name file, line, column, what was found and what
  /// is expected, all faults at once.
  static types::Result<World> load(const std::filesystem::path& file);

  /// As load, from a text, for tests; `name` replaces the file name in messages.
  static types::Result<World> from_scene_text(const std::string& text, const std::string& name);

  [[nodiscard]] const std::string& name() const;
  [[nodiscard]] const types::Rectangle& extents() const;
  [[nodiscard]] double ceiling_m() const;
  /// At least one. For an image without `start`: the free position with the largest clearance.
  [[nodiscard]] std::span<const Se2> start_poses() const;
  /// Outlines of all standing or hanging objects, for pictures; walls of an image are in wall_outlines().
  [[nodiscard]] std::span<const Prism> prisms() const;
  [[nodiscard]] std::span<const Polygon> wall_outlines() const;
  [[nodiscard]] std::span<const types::Segment> glass() const;

  /// The first surface along the ray.
  [[nodiscard]] RayHit cast(const Ray& ray, const RayOptions& options = {}) const;
  /// Range of a level ray at height z_m; infinity when nothing is within range_max_m.
  [[nodiscard]] double level_range_m(double x_m, double y_m, double z_m, double angle_rad,
                                     const RayOptions& options = {}) const;

  /// Contact of a convex outline (body frame, counter-clockwise) at `pose` between two heights, if any.
  [[nodiscard]] Touch touch(const Polygon& convex, const Se2& pose, double z_min_m, double z_max_m,
                            MovableId exclude = kNoMovable) const;

  /// True when the point is inside an immovable object.
  [[nodiscard]] bool solid_at(double x_m, double y_m, double z_m) const;

  /// 1 where no immovable object is between 0.03 and 0.5 m: the space of a robot. The outside of a drawn
  /// building counts as free here; reachable_area() of area.hpp does not reach it.
  [[nodiscard]] const Raster& structure() const;
  /// The same between two heights.
  [[nodiscard]] Raster free_mask(double z_min_m, double z_max_m) const;

  MovableId add_movable(Prism prism);
  void move_movable(MovableId id, Prism prism);
  void remove_movable(MovableId id);

 private:
  struct Movable {
    Prism prism;
    Vector2 center;
    double radius_m = 0.0;
    bool present = false;
  };
  explicit World(std::shared_ptr<const StaticWorld> building);
  void cast_movables(const Ray& ray, const RayOptions& options, RayHit& best) const;

  std::shared_ptr<const StaticWorld> building_;
  std::vector<Movable> movables_;
};

}  // namespace topo::sim
