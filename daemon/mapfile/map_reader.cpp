// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>

#include "daemon/mapfile/grey_image.hpp"
#include "daemon/mapfile/input_file.hpp"
#include "daemon/mapfile/map_image.hpp"

namespace topo::daemon {

using types::Errc;
using types::Result;
using types::Status;

namespace {

constexpr std::size_t kMaxYamlBytes = 65536;
constexpr std::size_t kMaxImageBytes = std::size_t{1} << 29U;
constexpr double kMaxCoordinate_m = 1e6;

/// The contents of a map_server YAML file.
struct MapYaml {
  std::string image;
  double resolution_m = 0.0;
  types::Se2 origin;
  bool negate = false;
  bool is_raw = false;  ///< the grey values are percentages of occupancy
  double occupied_thresh = 0.65;
  double free_thresh = 0.196;
  std::vector<std::string> warnings;
};

/// "nan" in any of the ways in which programs print it: -nan, .NaN, nan(ind).
bool says_not_a_number(const YAML::Node& node) {
  if (!node.IsDefined() || !node.IsScalar()) return false;
  std::string text = node.Scalar();
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  const std::size_t begin = text.find_first_not_of("+-.");
  if (begin > 2 || text.compare(begin, 3, "nan") != 0) return false;
  return text.size() == begin + 3 || text[begin + 3] == '(';
}

/// Reads keys of one YAML mapping. yaml-cpp is used only here; read_yaml() catches its exceptions.
class Keys {
 public:
  Keys(const std::string& path, const YAML::Node& root) : path_(path), root_(root) {}

  [[nodiscard]] tl::unexpected<types::Error> bad(const std::string& key, const YAML::Node& node,
                                                 std::string_view expected) const {
    const int line = (node.IsDefined() ? node : root_).Mark().line + 1;
    return bad_file(path_, fmt::format("line {}: key {}", line, key), found(node), expected);
  }
  [[nodiscard]] YAML::Node node(const std::string& key) const { return root_[key]; }

  [[nodiscard]] Result<double> number(const std::string& key, const YAML::Node& node, double min,
                                      double max) const {
    double value = 0.0;
    // Written so that NaN is refused too.
    if (!node.IsDefined() || !node.IsScalar() || !YAML::convert<double>::decode(node, value) ||
        !(value >= min && value <= max)) {
      return bad(key, node, fmt::format("a number from {} to {}", min, max));
    }
    return value;
  }
  Status number_if_there(const std::string& key, double min, double max, double& into) const {
    const YAML::Node n = node(key);
    if (!n.IsDefined()) return {};
    const auto value = number(key, n, min, max);
    if (!value.has_value()) return tl::unexpected(value.error());
    into = *value;
    return {};
  }

 private:
  static std::string found(const YAML::Node& node) {
    if (!node.IsDefined()) return "nothing";
    if (!node.IsScalar())
      return node.IsSequence() ? fmt::format("a list of {}", node.size()) : "no plain value";
    return fmt::format("\"{}\"", node.Scalar().substr(0, 60));
  }
  const std::string& path_;
  const YAML::Node& root_;
};

/// For a duplicate key, yaml-cpp would silently use the first.
Status no_key_twice(const std::string& path, const YAML::Node& root) {
  std::map<std::string, int> line_of;
  for (const auto& entry : root) {
    if (!entry.first.IsScalar()) continue;
    const std::string& key = entry.first.Scalar();
    const int line = entry.first.Mark().line + 1;
    const auto [first, fresh] = line_of.emplace(key, line);
    if (!fresh)
      return bad_file(path, fmt::format("line {}: key {}", line, key), "it once more",
                      fmt::format("one only: line {} has it", first->second));
  }
  return {};
}

Status read_origin(const Keys& keys, MapYaml& map) {
  const YAML::Node origin = keys.node("origin");
  if (!origin.IsDefined() || !origin.IsSequence() || origin.size() != 3)
    return keys.bad("origin", origin, "a list [x, y, yaw] in metres and radians");
  double values[3] = {};
  for (std::size_t i = 0; i < 3; ++i) {
    if (i == 2 && says_not_a_number(origin[i])) {
      map.warnings.push_back(fmt::format("line {}: key origin: took the yaw \"{}\" as 0",
                                         origin[i].Mark().line + 1, origin[i].Scalar()));
      break;
    }
    const auto value = keys.number("origin", origin[i], -kMaxCoordinate_m, kMaxCoordinate_m);
    if (!value.has_value()) return tl::unexpected(value.error());
    values[i] = *value;
  }
  map.origin = {values[0], values[1], types::wrap_angle(values[2])};
  return {};
}

Status read_mode(const Keys& keys, MapYaml& map) {
  const YAML::Node mode = keys.node("mode");
  if (!mode.IsDefined()) return {};
  const std::string text = mode.IsScalar() ? mode.Scalar() : "";
  if (text != "trinary" && text != "scale" && text != "raw")
    return keys.bad("mode", mode, "trinary, scale or raw");
  map.is_raw = text == "raw";  // "scale" has shades between free and occupied; they count as unknown
  return {};
}

Status read_negate(const Keys& keys, MapYaml& map) {
  const YAML::Node negate = keys.node("negate");
  if (!negate.IsDefined()) return {};
  const std::string text = negate.IsScalar() ? negate.Scalar() : "";
  map.negate = text == "1";
  if (text == "0" || text == "1" || (negate.IsScalar() && YAML::convert<bool>::decode(negate, map.negate)))
    return {};
  return keys.bad("negate", negate, "0 or 1, or YAML's yes or no");
}

Result<MapYaml> read_keys(const std::string& path, const YAML::Node& root) {
  if (!root.IsMap())
    return bad_file(path, "", "no keys", "a map_server file with image, resolution and origin");
  if (auto s = no_key_twice(path, root); !s.has_value()) return tl::unexpected(s.error());
  const Keys keys(path, root);
  MapYaml map;
  const YAML::Node image = keys.node("image");
  if (!image.IsDefined() || !image.IsScalar() || image.Scalar().empty())
    return keys.bad("image", image, "the image's path");
  map.image = image.Scalar();
  const auto resolution = keys.number("resolution", keys.node("resolution"), 1e-4, 100.0);
  if (!resolution.has_value()) return tl::unexpected(resolution.error());
  map.resolution_m = *resolution;
  for (const Status& s : {read_origin(keys, map), read_negate(keys, map), read_mode(keys, map),
                          keys.number_if_there("occupied_thresh", 0.0, 1.0, map.occupied_thresh),
                          keys.number_if_there("free_thresh", 0.0, 1.0, map.free_thresh)}) {
    if (!s.has_value()) return tl::unexpected(s.error());
  }
  if (map.free_thresh > map.occupied_thresh) {
    return keys.bad("free_thresh", keys.node("free_thresh"),
                    fmt::format("at most occupied_thresh, {}", map.occupied_thresh));
  }
  return map;
}

Result<MapYaml> read_yaml(const std::string& path, const std::string& text) {
  try {
    return read_keys(path, YAML::Load(text));
  } catch (const YAML::Exception& e) {  // the library reports errors only in this way
    return bad_file(path, fmt::format("line {}", e.mark.line + 1), e.msg, "YAML");
  }
}

/// Probability of occupancy; nothing when the file marks it as unknown.
std::optional<double> occupancy_of(const GreyImage& image, std::size_t pixel, const MapYaml& yaml) {
  constexpr double kAll = 100.0, kByte = 255.0;
  if (yaml.is_raw) {  // the value of a byte is a percentage
    const double percent = std::round(image.shade(pixel) * kByte);
    return percent <= kAll ? std::optional(percent / kAll) : std::nullopt;
  }
  const int value = image.pixels[pixel];
  return static_cast<double>(yaml.negate ? value : image.greatest - value) /
         static_cast<double>(image.greatest);
}

MapCell cell_of(const GreyImage& image, std::size_t pixel, const MapYaml& yaml) {
  const std::optional<double> occupied = occupancy_of(image, pixel, yaml);
  if (!occupied) return MapCell::kUnknown;
  if (*occupied > yaml.occupied_thresh) return MapCell::kOccupied;
  return *occupied < yaml.free_thresh ? MapCell::kFree : MapCell::kUnknown;
}

Result<GreyImage> read_image(const std::string& path) {
  const auto content = read_file(path, kMaxImageBytes);
  if (!content.has_value()) return tl::unexpected(content.error());
  if (content->starts_with("\x89PNG")) return decode_png(path, *content);
  if (content->starts_with("P2") || content->starts_with("P5")) return decode_pgm(path, *content);
  return bad_file(path, "byte 0", "other content", "a PGM (P2, P5) or PNG image");
}

/// The image where the file says, else of that name beside the file: maps are copied from computer to
/// computer, and a path in them may be that of another one.
Result<GreyImage> find_image(const std::string& yaml_path, MapYaml& yaml) {
  const std::filesystem::path folder = std::filesystem::path(yaml_path).parent_path();
  const std::string said = (folder / yaml.image).string();
  auto image = read_image(said);
  if (image.has_value()) return image;
  const bool absent = image.error().code == Errc::kNotFound || image.error().code == Errc::kPermission;
  const std::size_t slash = yaml.image.find_last_of("/\\");
  if (!absent || slash == std::string::npos || slash + 1 == yaml.image.size()) return image;
  const std::string beside = (folder / yaml.image.substr(slash + 1)).string();
  auto found = read_image(beside);
  if (!found.has_value() && found.error().code == Errc::kNotFound) return image;
  if (found.has_value())
    yaml.warnings.push_back(fmt::format("key image: {} is not there, took {} beside it", yaml.image, beside));
  return found;
}

}  // namespace

Result<MapImage> load_map(const std::string& yaml_path) {
  const auto text = read_file(yaml_path, kMaxYamlBytes);
  if (!text.has_value()) return tl::unexpected(text.error());
  auto yaml = read_yaml(yaml_path, *text);
  if (!yaml.has_value()) return tl::unexpected(yaml.error());
  const auto image = find_image(yaml_path, *yaml);
  if (!image.has_value()) return tl::unexpected(image.error());
  MapImage map{image->width,
               image->height,
               yaml->resolution_m,
               yaml->origin,
               std::vector<MapCell>(image->pixels.size()),
               std::move(yaml->warnings)};
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const std::size_t from = map.index(x, map.height - 1 - y);
      const bool empty = !image->transparent.empty() && image->transparent[from];
      map.cells[map.index(x, y)] = empty ? MapCell::kUnknown : cell_of(*image, from, *yaml);
    }
  }
  return map;
}

}  // namespace topo::daemon
