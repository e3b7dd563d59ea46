// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// Drawn 2.5-D scenes. config/worlds/office.toml explains every key.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "tests/sim/scene_parts.hpp"
#include "tests/sim/scene_reader.hpp"
#include "tests/sim/static_world.hpp"

namespace topo::sim {

namespace {

using types::Errc;

constexpr double kHigh_m = 20.0;

class SceneParser {
 public:
  SceneParser(const toml::table& root, Faults& faults) : root_(root), faults_(faults) {}

  StaticWorld parse() {
    TableReader top(root_, "scene", faults_);
    top.allow({"name", "ceiling_m", "start", "wall", "box", "cylinder", "glass", "clutter"});
    top.text("name", world_.name);
    top.number("ceiling_m", false, 1.0, kHigh_m, world_.ceiling_m);
    each("wall", &SceneParser::wall);
    each("box", &SceneParser::box);
    each("cylinder", &SceneParser::cylinder);
    each("clutter", &SceneParser::clutter);
    each("glass", &SceneParser::glass);
    if (world_.prisms.empty() && world_.glass_edges.empty() && !faults_.any()) {
      faults_.add(root_.source(),
                  "scene: nothing is drawn; expected at least one [[wall]], [[box]] or [[cylinder]]");
    }
    if (!faults_.any()) finish(world_);
    each("start", &SceneParser::start);
    if (world_.starts.empty() && !faults_.any()) {
      faults_.add(root_.source(), "scene: no [[start]]; expected at least one with x_m, y_m and theta_rad");
    }
    return std::move(world_);
  }

 private:
  void each(std::string_view key, void (SceneParser::*read)(TableReader&)) {
    const toml::node* node = root_.get(key);
    if (node == nullptr) return;
    const toml::array* list = node->as_array();
    if (list == nullptr || !list->is_homogeneous(toml::node_type::table)) {
      return faults_.add(node->source(),
                         fmt::format("scene: '{0}' is no list of tables; expected [[{0}]]", key));
    }
    for (const toml::node& item : *list) {
      TableReader reader(*item.as_table(), fmt::format("[[{}]]", key), faults_);
      (this->*read)(reader);
    }
  }

  // z_min_m and z_max_m, in order.
  bool heights(TableReader& r, bool required, double& z_min_m, double& z_max_m) {
    r.number("z_min_m", false, 0.0, kHigh_m, z_min_m);
    if (!r.number("z_max_m", required, 0.0, kHigh_m, z_max_m) && r.has("z_max_m")) return false;
    if (z_min_m < z_max_m) return true;
    r.fault("z_max_m", fmt::format("is {:g}; expected more than z_min_m, which is {:g}", z_max_m, z_min_m));
    return false;
  }

  void start(TableReader& r) {
    r.allow({"x_m", "y_m", "theta_rad"});
    Se2 pose;
    const bool read =
        r.number("x_m", true, -kFar_m, kFar_m, pose.x_m) & r.number("y_m", true, -kFar_m, kFar_m, pose.y_m);
    r.number("theta_rad", false, -7.0, 7.0, pose.theta_rad);
    if (!read || faults_.any()) return;
    if (!world_.extents.contains(pose.translation())) {
      return r.fault(
          "x_m", fmt::format("puts the start ({:g}, {:g}) outside of everything drawn", pose.x_m, pose.y_m));
    }
    if (world_.structure.at(pose.translation()) == 0) {
      return r.fault("x_m",
                     fmt::format("puts the start ({:g}, {:g}) inside something solid; expected a free place",
                                 pose.x_m, pose.y_m));
    }
    world_.starts.push_back(pose);
  }

  void wall(TableReader& r) {
    r.allow({"points_m", "closed", "thickness_m", "z_min_m", "z_max_m", "openings", "alcoves", "clutter"});
    DrawnWall wall;
    wall.z_max_m = world_.ceiling_m;
    bool closed = false;
    if (!r.points("points_m", 2, wall.points)) return;
    r.flag("closed", closed);
    if (closed) wall.points.push_back(wall.points.front());
    for (std::size_t i = 0; i + 1 < wall.points.size(); ++i) {
      if ((wall.points[i + 1] - wall.points[i]).norm() < 1e-3)
        return r.fault("points_m", fmt::format("has point {} twice; expected parts of 1 mm or more", i));
    }
    r.number("thickness_m", false, 0.01, 2.0, wall.thickness_m);
    if (!heights(r, false, wall.z_min_m, wall.z_max_m)) return;
    features(r, "openings", WallFeature::Kind::kOpening, wall);
    features(r, "alcoves", WallFeature::Kind::kAlcove, wall);
    wall_clutter(r, wall);
    if (const std::string fault = build_wall(wall, world_.prisms); !fault.empty())
      r.fault(r.has("openings") ? "openings" : "alcoves", fault);
  }

  void features(TableReader& r, std::string_view key, WallFeature::Kind kind, DrawnWall& wall) {
    each_in(r, key, [&](TableReader& f) {
      WallFeature feature;
      feature.kind = kind;
      std::string side = "left";
      if (kind == WallFeature::Kind::kOpening) {
        f.allow({"at_m", "width_m", "lintel_m"});
        f.number("lintel_m", false, 0.5, kHigh_m, feature.lintel_m);
      } else {
        f.allow({"at_m", "width_m", "depth_m", "side"});
        f.number("depth_m", true, 0.05, 5.0, feature.depth_m);
        f.word("side", {"left", "right"}, side);
      }
      feature.left = side == "left";
      const bool at = f.number("at_m", true, 0.0, kFar_m, feature.at_m);
      const bool wide = f.number("width_m", true, 0.1, kFar_m, feature.width_m);
      if (at && wide) wall.features.push_back(feature);
    });
  }

  void box(TableReader& r) {
    r.allow({"center_m", "length_m", "width_m", "theta_rad", "z_min_m", "z_max_m"});
    Vector2 center{0.0, 0.0};
    double length_m = 1.0, width_m = 1.0, theta_rad = 0.0, z_min_m = 0.0, z_max_m = world_.ceiling_m;
    const bool read = r.point("center_m", true, center) & r.number("length_m", true, 0.01, kFar_m, length_m) &
                      r.number("width_m", true, 0.01, kFar_m, width_m);
    r.number("theta_rad", false, -7.0, 7.0, theta_rad);
    if (heights(r, true, z_min_m, z_max_m) && read)
      world_.prisms.push_back(
          make_box({center.x(), center.y(), theta_rad}, length_m, width_m, z_min_m, z_max_m));
  }

  void cylinder(TableReader& r) {
    r.allow({"center_m", "radius_m", "z_min_m", "z_max_m"});
    Vector2 center{0.0, 0.0};
    double radius_m = 0.1, z_min_m = 0.0, z_max_m = world_.ceiling_m;
    const bool read = r.point("center_m", true, center) & r.number("radius_m", true, 0.01, 50.0, radius_m);
    if (heights(r, true, z_min_m, z_max_m) && read)
      world_.prisms.push_back(make_cylinder(center, radius_m, z_min_m, z_max_m));
  }

  // The keys common to free rows and rows along a wall.
  void row_keys(TableReader& r, ClutterRow& row) {
    double seed = 1.0;
    r.number("fraction", false, 0.0, 1.0, row.fraction);
    r.number("seed", false, 0.0, 1e9, seed);
    r.range("length_m", 0.05, 20.0, row.length_min_m, row.length_max_m);
    r.range("depth_m", 0.02, 20.0, row.depth_min_m, row.depth_max_m);
    r.range("height_m", 0.02, kHigh_m, row.height_min_m, row.height_max_m);
    row.seed = static_cast<std::uint64_t>(seed);
  }

  void clutter(TableReader& r) {
    r.allow({"from_m", "to_m", "fraction", "seed", "length_m", "depth_m", "height_m"});
    ClutterRow row;
    const bool read = r.point("from_m", true, row.from) & r.point("to_m", true, row.to);
    row_keys(r, row);
    if (!read) return;
    if ((row.to - row.from).norm() < 0.1) {
      return r.fault("to_m", "is less than 0.1 m from from_m; expected a line to put things along");
    }
    build_clutter(row, world_.prisms);
  }

  void wall_clutter(TableReader& r, DrawnWall& wall) {
    each_in(r, "clutter", [&](TableReader& c) {
      c.allow({"side", "margin_m", "fraction", "seed", "length_m", "depth_m", "height_m"});
      WallClutter clutter;
      std::string side = "left";
      c.word("side", {"left", "right"}, side);
      clutter.left = side == "left";
      c.number("margin_m", false, 0.0, 10.0, clutter.margin_m);
      row_keys(c, clutter.row);
      wall.clutter.push_back(clutter);
    });
  }

  // Inline tables of a list within a table.
  template <class Read>
  void each_in(TableReader& r, std::string_view key, const Read& read) {
    const toml::node* node = r.table().get(key);
    if (node == nullptr) return;
    if (!node->is_array() || !node->as_array()->is_homogeneous(toml::node_type::table)) {
      return r.fault(key, "is no list of tables; expected [{ ... }, { ... }]");
    }
    for (const toml::node& item : *node->as_array()) {
      TableReader inner(*item.as_table(), fmt::format("{} {}", r.what(), key), faults_);
      read(inner);
    }
  }

  void glass(TableReader& r) {
    r.allow({"points_m", "transmission", "z_min_m", "z_max_m"});
    std::vector<Vector2> points;
    double transmission = 0.7, z_min_m = 0.0, z_max_m = world_.ceiling_m;
    const bool read =
        r.points("points_m", 2, points) & r.number("transmission", true, 0.0, 1.0, transmission);
    if (!heights(r, false, z_min_m, z_max_m) || !read) return;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      world_.glass.push_back({points[i], points[i + 1]});
      world_.glass_edges.push_back(
          {points[i], points[i + 1], z_min_m, z_max_m, transmission, Surface::kGlass});
    }
  }

  const toml::table& root_;
  Faults& faults_;
  StaticWorld world_;
};

}  // namespace

types::Result<StaticWorld> parse_scene(const std::string& text, const std::string& name) {
  Faults faults(name);
  toml::table root;
  try {
    root = toml::parse(text, name);
  } catch (const toml::parse_error& e) {
    faults.add(e.source(), fmt::format("no TOML: {}", e.description()));
    return types::fail(Errc::kInvalidInput, faults.text());
  }
  StaticWorld world = SceneParser(root, faults).parse();
  if (faults.any()) return types::fail(Errc::kInvalidInput, faults.text());
  if (world.name.empty()) world.name = std::filesystem::path(name).stem().string();
  return world;
}

}  // namespace topo::sim
