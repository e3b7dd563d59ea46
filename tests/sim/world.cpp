// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/sim/world.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "tests/sim/static_world.hpp"

namespace topo::sim {

namespace {

// Middle of the part of the edge inside the convex outline (Cyrus and Beck 1978).
Touch clip_edge(const Polygon& convex, const Vector2& a, const Vector2& b) {
  double low = 0.0;
  double high = 1.0;
  for (std::size_t i = 0, j = convex.size() - 1; i < convex.size(); j = i++) {
    const Vector2 side = convex[i] - convex[j];
    const Vector2 inward(-side.y(), side.x());
    const double from = inward.dot(a - convex[j]);
    const double to = inward.dot(b - convex[j]);
    if (from < 0.0 && to < 0.0) return {};
    if (from < 0.0) low = std::max(low, from / (from - to));
    if (to < 0.0) high = std::min(high, from / (from - to));
    if (low > high) return {};
  }
  return {true, a + (b - a) * (0.5 * (low + high))};
}

double radius_of(const Polygon& outline, const Vector2& center) {
  double radius = 0.0;
  for (const Vector2& p : outline) radius = std::max(radius, (p - center).norm());
  return radius;
}

types::Result<std::string> read_text(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in)
    return types::fail(types::Errc::kNotFound,
                       file.string() + ": cannot be opened; expected a readable world file");
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

}  // namespace

World::World(std::shared_ptr<const StaticWorld> building) : building_(std::move(building)) {}

types::Result<World> World::load(const std::filesystem::path& file) {
  if (file.extension() == ".toml") {
    auto text = read_text(file);
    if (!text.has_value()) return tl::unexpected<types::Error>(text.error());
    return from_scene_text(*text, file.string());
  }
  if (file.extension() != ".yaml" && file.extension() != ".yml") {
    return types::fail(types::Errc::kInvalidInput,
                       file.string() + ": found extension '" + file.extension().string() +
                           "', expected a map_server map (.yaml) or a drawn scene (.toml)");
  }
  auto loaded = load_image_world(file);
  if (!loaded.has_value()) return tl::unexpected<types::Error>(loaded.error());
  return World(std::make_shared<const StaticWorld>(std::move(*loaded)));
}

types::Result<World> World::from_scene_text(const std::string& text, const std::string& name) {
  auto parsed = parse_scene(text, name);
  if (!parsed.has_value()) return tl::unexpected<types::Error>(parsed.error());
  return World(std::make_shared<const StaticWorld>(std::move(*parsed)));
}

const std::string& World::name() const { return building_->name; }
const types::Rectangle& World::extents() const { return building_->extents; }
double World::ceiling_m() const { return building_->ceiling_m; }
std::span<const Se2> World::start_poses() const { return building_->starts; }
std::span<const Prism> World::prisms() const { return building_->prisms; }
std::span<const Polygon> World::wall_outlines() const { return building_->wall_outlines; }
std::span<const types::Segment> World::glass() const { return building_->glass; }
const Raster& World::structure() const { return building_->structure; }

Raster World::free_mask(double z_min_m, double z_max_m) const {
  return compute_free_mask(*building_, z_min_m, z_max_m);
}

bool World::solid_at(double x_m, double y_m, double z_m) const {
  return building_->walls.at(Vector2(x_m, y_m)) != 0 ||
         building_->index.in_prism(x_m, y_m, z_m, building_->prisms);
}

RayHit World::cast(const Ray& ray, const RayOptions& options) const {
  RayHit best{options.range_max_m, 0.0, Surface::kNone};
  if (ray.dz < 0.0 && -ray.z / ray.dz < best.range_m) best = {-ray.z / ray.dz, -ray.dz, Surface::kFloor};
  if (ray.dz > 0.0 && (ceiling_m() - ray.z) / ray.dz < best.range_m) {
    best = {(ceiling_m() - ray.z) / ray.dz, ray.dz, Surface::kCeiling};
  }
  building_->index.cast(ray, options.glass_draw, building_->prisms, best);
  cast_movables(ray, options, best);
  if (best.surface == Surface::kNone) best.range_m = HUGE_VAL;
  return best;
}

double World::level_range_m(double x_m, double y_m, double z_m, double angle_rad,
                            const RayOptions& options) const {
  return cast({x_m, y_m, z_m, std::cos(angle_rad), std::sin(angle_rad), 0.0}, options).range_m;
}

void World::cast_movables(const Ray& ray, const RayOptions& options, RayHit& best) const {
  for (std::size_t id = 0; id < movables_.size(); ++id) {
    const Movable& movable = movables_[id];
    if (!movable.present || static_cast<MovableId>(id) == options.exclude) continue;
    const double rx = movable.center.x() - ray.x;
    const double ry = movable.center.y() - ray.y;
    if (std::abs(ray.dx * ry - ray.dy * rx) > movable.radius_m) continue;
    const Polygon& outline = movable.prism.outline;
    for (std::size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++) {
      const Crossing hit = cross(ray, {outline[j], outline[i], movable.prism.z_min_m, movable.prism.z_max_m});
      if (hit.t < best.range_m) best = {hit.t, hit.cos_incidence, Surface::kMovable};
    }
    const Crossing cap = cross_caps(ray, movable.prism);
    if (cap.t < best.range_m) best = {cap.t, cap.cos_incidence, Surface::kMovable};
  }
}

Touch World::touch(const Polygon& convex, const Se2& pose, double z_min_m, double z_max_m,
                   MovableId exclude) const {
  const double radius_m = radius_of(convex, {0.0, 0.0});
  const Vector2 center = pose.translation();
  const Se2 to_body = pose.inverse();
  Touch found;
  const auto consider = [&](const Vector2& a, const Vector2& b, double low_m, double high_m) {
    if (found.touching || low_m >= z_max_m || high_m <= z_min_m) return;
    if (std::min(a.x(), b.x()) > center.x() + radius_m || std::max(a.x(), b.x()) < center.x() - radius_m)
      return;
    if (std::min(a.y(), b.y()) > center.y() + radius_m || std::max(a.y(), b.y()) < center.y() - radius_m)
      return;
    found = clip_edge(convex, to_body * a, to_body * b);
  };
  building_->index.near(center, radius_m, [&](const Edge& e) { consider(e.a, e.b, e.z_min_m, e.z_max_m); });
  for (std::size_t id = 0; id < movables_.size() && !found.touching; ++id) {
    const Movable& movable = movables_[id];
    if (!movable.present || static_cast<MovableId>(id) == exclude) continue;
    if ((movable.center - center).norm() > radius_m + movable.radius_m) continue;
    const Polygon& outline = movable.prism.outline;
    for (std::size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++) {
      consider(outline[j], outline[i], movable.prism.z_min_m, movable.prism.z_max_m);
    }
  }
  return found;
}

MovableId World::add_movable(Prism prism) {
  movables_.emplace_back();
  const auto id = static_cast<MovableId>(movables_.size() - 1);
  move_movable(id, std::move(prism));
  return id;
}

void World::move_movable(MovableId id, Prism prism) {
  Movable& movable = movables_.at(static_cast<std::size_t>(id));
  movable.prism = std::move(prism);
  const types::Rectangle box = bounds(movable.prism.outline);
  movable.center = 0.5 * (box.min + box.max);
  movable.radius_m = radius_of(movable.prism.outline, movable.center);
  movable.present = true;
}

void World::remove_movable(MovableId id) { movables_.at(static_cast<std::size_t>(id)).present = false; }

}  // namespace topo::sim
