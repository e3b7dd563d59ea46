// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// Buildings from ROS map_server maps.

#include <yaml-cpp/yaml.h>

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "tests/sim/area.hpp"
#include "tests/sim/contours.hpp"
#include "tests/sim/image_file.hpp"
#include "tests/sim/static_world.hpp"

namespace topo::sim {

namespace {

using types::Errc;

constexpr double kFurnitureAcross_m = 1.0;
constexpr double kFurnitureHeight_m = 0.8;
constexpr double kWallHeight_m = 2.5;
constexpr std::uint8_t kUnknown = 205;  // as written by map_saver
// The stairs of a slanted line are less than one cell deep.
constexpr double kStraighten_cells = 1.0;

struct MapFile {
  std::filesystem::path image;
  double resolution_m = 0.05;
  Vector2 origin{0.0, 0.0};
  bool negate = false;
  double occupied_threshold = 0.65;
  double free_threshold = 0.196;
  std::optional<Se2> start;
};

// Reads the keys and collects every fault with its position.
class MapFileReader {
 public:
  MapFileReader(const YAML::Node& root, std::string file) : root_(root), file_(std::move(file)) {}

  void number(const char* key, double low, double high, bool required, double& out) {
    const YAML::Node node = root_[key];
    if (!node.IsDefined()) {
      if (required)
        fault(root_, fmt::format("key '{}' is missing; expected a number from {:g} to {:g}", key, low, high));
      return;
    }
    scalar(node, key, low, high, out);
  }
  void numbers(const char* key, std::size_t least, std::vector<double>& out) {
    const YAML::Node node = root_[key];
    if (!node.IsDefined()) return;
    if (!node.IsSequence() || node.size() < least) {
      return fault(node, fmt::format("'{}' is no list of {} numbers or more", key, least));
    }
    out.assign(node.size(), 0.0);
    for (std::size_t i = 0; i < node.size(); ++i) {
      // An old map_saver wrote the yaw of a map that is not turned as -nan.
      const bool no_yaw = i == 2 && node[i].IsScalar() && node[i].Scalar().find("nan") <= 1;
      if (!no_yaw) scalar(node[i], key, -1e5, 1e5, out[i]);
    }
  }
  void text(const char* key, std::string& out) {
    const YAML::Node node = root_[key];
    if (!node.IsDefined() || !node.IsScalar() || node.Scalar().empty()) {
      return fault(node.IsDefined() ? node : root_,
                   fmt::format("key '{}' is missing or empty; expected a file name", key));
    }
    out = node.Scalar();
  }
  /// yaml-cpp would take the first of two without an error.
  void no_key_twice() {
    std::map<std::string, int> line_of;
    for (const auto& entry : root_) {
      if (!entry.first.IsScalar()) continue;
      const std::string& key = entry.first.Scalar();
      const auto [first, fresh] = line_of.emplace(key, entry.first.Mark().line + 1);
      if (!fresh)
        fault(entry.first,
              fmt::format("key '{}' stands in line {} already; expected it once", key, first->second));
    }
  }
  /// 0 and 1, or YAML's words for them.
  void truth(const char* key, bool& out) {
    const YAML::Node node = root_[key];
    if (!node.IsDefined() || (node.IsScalar() && YAML::convert<bool>::decode(node, out))) return;
    double value = 0.0;
    scalar(node, key, 0.0, 1.0, value);
    out = value != 0.0;
  }
  void not_turned(const std::vector<double>& origin) {
    constexpr double kRounding_rad = 1e-6;
    if (origin.size() > 2 && std::abs(types::wrap_angle(origin[2])) > kRounding_rad)
      fault(root_["origin"],
            fmt::format("'origin' has a yaw of {:g}; expected 0: turned maps are not read", origin[2]));
  }
  [[nodiscard]] const std::string& faults() const { return faults_; }

 private:
  void scalar(const YAML::Node& node, const char* key, double low, double high, double& out) {
    double value = 0.0;
    const bool read = node.IsScalar() && YAML::convert<double>::decode(node, value);
    if (!read || !std::isfinite(value) || value < low || value > high) {
      return fault(node, fmt::format("'{}' is '{}'; expected a number from {:g} to {:g}", key,
                                     node.IsScalar() ? node.Scalar() : "no number", low, high));
    }
    out = value;
  }
  void fault(const YAML::Node& node, const std::string& what) {
    const YAML::Mark mark = node.Mark();
    faults_ += fmt::format("{}{}:{}:{}: {}", faults_.empty() ? "" : "\n", file_, std::max(mark.line, 0) + 1,
                           std::max(mark.column, 0) + 1, what);
  }
  const YAML::Node& root_;
  std::string file_;
  std::string faults_;
};

types::Result<MapFile> read_map_file(const std::filesystem::path& yaml) {
  YAML::Node root;
  try {
    root = YAML::LoadFile(yaml.string());
  } catch (const YAML::BadFile&) {
    return types::fail(Errc::kNotFound, yaml.string() + ": cannot be opened; expected a map_server YAML");
  } catch (const YAML::Exception& e) {
    return types::fail(Errc::kInvalidInput, fmt::format("{}:{}:{}: no YAML: {}", yaml.string(),
                                                        e.mark.line + 1, e.mark.column + 1, e.msg));
  }
  if (!root.IsMap())
    return types::fail(Errc::kInvalidInput, yaml.string() + ":1:1: expected the keys of a map_server map");
  MapFileReader reader(root, yaml.string());
  MapFile map;
  std::string image;
  std::vector<double> origin{0.0, 0.0, 0.0};
  std::vector<double> start;
  reader.no_key_twice();
  reader.text("image", image);
  reader.number("resolution", 0.001, 1.0, true, map.resolution_m);
  reader.numbers("origin", 2, origin);
  reader.not_turned(origin);
  reader.truth("negate", map.negate);
  reader.number("occupied_thresh", 0.0, 1.0, false, map.occupied_threshold);
  reader.number("free_thresh", 0.0, 1.0, false, map.free_threshold);
  reader.numbers("start", 3, start);
  if (!reader.faults().empty()) return types::fail(Errc::kInvalidInput, reader.faults());
  map.image =
      std::filesystem::path(image).is_absolute() ? std::filesystem::path(image) : yaml.parent_path() / image;
  const std::filesystem::path beside = yaml.parent_path() / map.image.filename();
  // A map that was copied may hold the path of another computer.
  std::error_code absent;
  if (!std::filesystem::exists(map.image, absent) && std::filesystem::exists(beside, absent))
    map.image = beside;
  map.origin = {origin[0], origin[1]};
  if (!start.empty()) map.start = Se2{start[0], start[1], start[2]};
  return map;
}

// 1 = solid: occupied and unknown. Row 0 at the bottom.
Raster make_solid(const GreyImage& image, const MapFile& map) {
  Raster solid(map.resolution_m, map.origin, image.width, image.height, 1);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const std::uint8_t grey =
          image
              .pixels[static_cast<std::size_t>(image.height - 1 - y) * static_cast<std::size_t>(image.width) +
                      static_cast<std::size_t>(x)];
      const double occupied = (map.negate ? grey : 255 - grey) / 255.0;
      if (grey != kUnknown && occupied < map.free_threshold) solid.set(x, y, 0);
    }
  }
  return solid;
}

// Separates walls from furniture by the size of the pieces, and extrudes both.
void extrude(const Raster& solid, StaticWorld& world) {
  const Pieces pieces = label_pieces(solid);
  std::vector<bool> low(pieces.box.size(), false);
  for (std::size_t i = 1; i < low.size(); ++i) {
    const Vector2 size = pieces.box[i].max - pieces.box[i].min;
    low[i] = !pieces.at_border[i] && size.maxCoeff() < kFurnitureAcross_m;
  }
  for (Contour& contour : trace_contours(solid, pieces, kStraighten_cells)) {
    if (low[contour.piece] && area_m2(contour.outline) > 0.0) {
      world.prisms.push_back({std::move(contour.outline), 0.0, kFurnitureHeight_m});
    } else if (!low[contour.piece]) {
      world.wall_outlines.push_back(std::move(contour.outline));
    }
  }
  world.walls = solid;
  for (std::size_t i = 0; i < solid.cells.size(); ++i) {
    if (low[pieces.label[i]]) world.walls.cells[i] = 0;
  }
}

}  // namespace

types::Result<StaticWorld> load_image_world(const std::filesystem::path& yaml) {
  const auto map = read_map_file(yaml);
  if (!map.has_value()) return tl::unexpected<types::Error>(map.error());
  const auto image = read_image(map->image);
  if (!image.has_value()) return tl::unexpected<types::Error>(image.error());
  const Raster solid = make_solid(*image, *map);
  if (std::all_of(solid.cells.begin(), solid.cells.end(), [](std::uint8_t c) { return c != 0; })) {
    return types::fail(Errc::kInvalidInput,
                       map->image.string() + ": no free pixel; expected free space lighter than free_thresh");
  }
  StaticWorld world;
  world.name = yaml.stem().string();
  world.ceiling_m = kWallHeight_m;
  extrude(solid, world);
  finish(world);
  const Se2 start = map->start.value_or(roomiest_place(world.structure));
  if (world.structure.at(start.translation()) == 0) {
    return types::fail(Errc::kInvalidInput,
                       fmt::format("{}: start ({:g}, {:g}) is inside something solid; expected a free place",
                                   yaml.string(), start.x_m, start.y_m));
  }
  world.starts = {start};
  return world;
}

}  // namespace topo::sim
